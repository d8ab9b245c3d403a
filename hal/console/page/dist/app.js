/*!
Stylet console. SPDX-License-Identifier: Apache-2.0
Built by hal/console/page/build.mjs, with these libraries:

---- three 0.170.0 (MIT) ----

The MIT License

Copyright © 2010-2024 three.js authors

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.

---- uplot 1.6.32 (MIT) ----

The MIT License (MIT)

Copyright (c) 2022 Leon Sorokin

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.

---- flatbuffers 2.0.7 (SEE LICENSE IN LICENSE.txt) ----

Apache License
                           Version 2.0, January 2004
                        http://www.apache.org/licenses/

   TERMS AND CONDITIONS FOR USE, REPRODUCTION, AND DISTRIBUTION

   1. Definitions.

      "License" shall mean the terms and conditions for use, reproduction,
      and distribution as defined by Sections 1 through 9 of this document.

      "Licensor" shall mean the copyright owner or entity authorized by
      the copyright owner that is granting the License.

      "Legal Entity" shall mean the union of the acting entity and all
      other entities that control, are controlled by, or are under common
      control with that entity. For the purposes of this definition,
      "control" means (i) the power, direct or indirect, to cause the
      direction or management of such entity, whether by contract or
      otherwise, or (ii) ownership of fifty percent (50%) or more of the
      outstanding shares, or (iii) beneficial ownership of such entity.

      "You" (or "Your") shall mean an individual or Legal Entity
      exercising permissions granted by this License.

      "Source" form shall mean the preferred form for making modifications,
      including but not limited to software source code, documentation
      source, and configuration files.

      "Object" form shall mean any form resulting from mechanical
      transformation or translation of a Source form, including but
      not limited to compiled object code, generated documentation,
      and conversions to other media types.

      "Work" shall mean the work of authorship, whether in Source or
      Object form, made available under the License, as indicated by a
      copyright notice that is included in or attached to the work
      (an example is provided in the Appendix below).

      "Derivative Works" shall mean any work, whether in Source or Object
      form, that is based on (or derived from) the Work and for which the
      editorial revisions, annotations, elaborations, or other modifications
      represent, as a whole, an original work of authorship. For the purposes
      of this License, Derivative Works shall not include works that remain
      separable from, or merely link (or bind by name) to the interfaces of,
      the Work and Derivative Works thereof.

      "Contribution" shall mean any work of authorship, including
      the original version of the Work and any modifications or additions
      to that Work or Derivative Works thereof, that is intentionally
      submitted to Licensor for inclusion in the Work by the copyright owner
      or by an individual or Legal Entity authorized to submit on behalf of
      the copyright owner. For the purposes of this definition, "submitted"
      means any form of electronic, verbal, or written communication sent
      to the Licensor or its representatives, including but not limited to
      communication on electronic mailing lists, source code control systems,
      and issue tracking systems that are managed by, or on behalf of, the
      Licensor for the purpose of discussing and improving the Work, but
      excluding communication that is conspicuously marked or otherwise
      designated in writing by the copyright owner as "Not a Contribution."

      "Contributor" shall mean Licensor and any individual or Legal Entity
      on behalf of whom a Contribution has been received by Licensor and
      subsequently incorporated within the Work.

   2. Grant of Copyright License. Subject to the terms and conditions of
      this License, each Contributor hereby grants to You a perpetual,
      worldwide, non-exclusive, no-charge, royalty-free, irrevocable
      copyright license to reproduce, prepare Derivative Works of,
      publicly display, publicly perform, sublicense, and distribute the
      Work and such Derivative Works in Source or Object form.

   3. Grant of Patent License. Subject to the terms and conditions of
      this License, each Contributor hereby grants to You a perpetual,
      worldwide, non-exclusive, no-charge, royalty-free, irrevocable
      (except as stated in this section) patent license to make, have made,
      use, offer to sell, sell, import, and otherwise transfer the Work,
      where such license applies only to those patent claims licensable
      by such Contributor that are necessarily infringed by their
      Contribution(s) alone or by combination of their Contribution(s)
      with the Work to which such Contribution(s) was submitted. If You
      institute patent litigation against any entity (including a
      cross-claim or counterclaim in a lawsuit) alleging that the Work
      or a Contribution incorporated within the Work constitutes direct
      or contributory patent infringement, then any patent licenses
      granted to You under this License for that Work shall terminate
      as of the date such litigation is filed.

   4. Redistribution. You may reproduce and distribute copies of the
      Work or Derivative Works thereof in any medium, with or without
      modifications, and in Source or Object form, provided that You
      meet the following conditions:

      (a) You must give any other recipients of the Work or
          Derivative Works a copy of this License; and

      (b) You must cause any modified files to carry prominent notices
          stating that You changed the files; and

      (c) You must retain, in the Source form of any Derivative Works
          that You distribute, all copyright, patent, trademark, and
          attribution notices from the Source form of the Work,
          excluding those notices that do not pertain to any part of
          the Derivative Works; and

      (d) If the Work includes a "NOTICE" text file as part of its
          distribution, then any Derivative Works that You distribute must
          include a readable copy of the attribution notices contained
          within such NOTICE file, excluding those notices that do not
          pertain to any part of the Derivative Works, in at least one
          of the following places: within a NOTICE text file distributed
          as part of the Derivative Works; within the Source form or
          documentation, if provided along with the Derivative Works; or,
          within a display generated by the Derivative Works, if and
          wherever such third-party notices normally appear. The contents
          of the NOTICE file are for informational purposes only and
          do not modify the License. You may add Your own attribution
          notices within Derivative Works that You distribute, alongside
          or as an addendum to the NOTICE text from the Work, provided
          that such additional attribution notices cannot be construed
          as modifying the License.

      You may add Your own copyright statement to Your modifications and
      may provide additional or different license terms and conditions
      for use, reproduction, or distribution of Your modifications, or
      for any such Derivative Works as a whole, provided Your use,
      reproduction, and distribution of the Work otherwise complies with
      the conditions stated in this License.

   5. Submission of Contributions. Unless You explicitly state otherwise,
      any Contribution intentionally submitted for inclusion in the Work
      by You to the Licensor shall be under the terms and conditions of
      this License, without any additional terms or conditions.
      Notwithstanding the above, nothing herein shall supersede or modify
      the terms of any separate license agreement you may have executed
      with Licensor regarding such Contributions.

   6. Trademarks. This License does not grant permission to use the trade
      names, trademarks, service marks, or product names of the Licensor,
      except as required for reasonable and customary use in describing the
      origin of the Work and reproducing the content of the NOTICE file.

   7. Disclaimer of Warranty. Unless required by applicable law or
      agreed to in writing, Licensor provides the Work (and each
      Contributor provides its Contributions) on an "AS IS" BASIS,
      WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or
      implied, including, without limitation, any warranties or conditions
      of TITLE, NON-INFRINGEMENT, MERCHANTABILITY, or FITNESS FOR A
      PARTICULAR PURPOSE. You are solely responsible for determining the
      appropriateness of using or redistributing the Work and assume any
      risks associated with Your exercise of permissions under this License.

   8. Limitation of Liability. In no event and under no legal theory,
      whether in tort (including negligence), contract, or otherwise,
      unless required by applicable law (such as deliberate and grossly
      negligent acts) or agreed to in writing, shall any Contributor be
      liable to You for damages, including any direct, indirect, special,
      incidental, or consequential damages of any character arising as a
      result of this License or out of the use or inability to use the
      Work (including but not limited to damages for loss of goodwill,
      work stoppage, computer failure or malfunction, or any and all
      other commercial damages or losses), even if such Contributor
      has been advised of the possibility of such damages.

   9. Accepting Warranty or Additional Liability. While redistributing
      the Work or Derivative Works thereof, You may choose to offer,
      and charge a fee for, acceptance of support, warranty, indemnity,
      or other liability obligations and/or rights consistent with this
      License. However, in accepting such obligations, You may act only
      on Your own behalf and on Your sole responsibility, not on behalf
      of any other Contributor, and only if You agree to indemnify,
      defend, and hold each Contributor harmless for any liability
      incurred by, or claims asserted against, such Contributor by reason
      of your accepting any such warranty or additional liability.

   END OF TERMS AND CONDITIONS

   APPENDIX: How to apply the Apache License to your work.

      To apply the Apache License to your work, attach the following
      boilerplate notice, with the fields enclosed by brackets "[]"
      replaced with your own identifying information. (Don't include
      the brackets!)  The text should be enclosed in the appropriate
      comment syntax for the file format. We also recommend that a
      file or class name and description of purpose be included on the
      same "printed page" as the copyright notice for easier
      identification within third-party archives.

   Copyright [yyyy] [name of copyright owner]

   Licensed under the Apache License, Version 2.0 (the "License");
   you may not use this file except in compliance with the License.
   You may obtain a copy of the License at

       http://www.apache.org/licenses/LICENSE-2.0

   Unless required by applicable law or agreed to in writing, software
   distributed under the License is distributed on an "AS IS" BASIS,
   WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
   See the License for the specific language governing permissions and
   limitations under the License.
*/const Ps=new Int32Array(2),wf=new Float32Array(Ps.buffer),Ef=new Float64Array(Ps.buffer),ga=new Uint16Array(new Uint8Array([1,0]).buffer)[0]===1;var ch;(function(i){i[i.UTF8_BYTES=1]="UTF8_BYTES",i[i.UTF16_STRING=2]="UTF16_STRING"})(ch||(ch={}));class co{constructor(t){this.bytes_=t,this.position_=0,this.text_decoder_=new TextDecoder}static allocate(t){return new co(new Uint8Array(t))}clear(){this.position_=0}bytes(){return this.bytes_}position(){return this.position_}setPosition(t){this.position_=t}capacity(){return this.bytes_.length}readInt8(t){return this.readUint8(t)<<24>>24}readUint8(t){return this.bytes_[t]}readInt16(t){return this.readUint16(t)<<16>>16}readUint16(t){return this.bytes_[t]|this.bytes_[t+1]<<8}readInt32(t){return this.bytes_[t]|this.bytes_[t+1]<<8|this.bytes_[t+2]<<16|this.bytes_[t+3]<<24}readUint32(t){return this.readInt32(t)>>>0}readInt64(t){return BigInt.asIntN(64,BigInt(this.readUint32(t))+(BigInt(this.readUint32(t+4))<<BigInt(32)))}readUint64(t){return BigInt.asUintN(64,BigInt(this.readUint32(t))+(BigInt(this.readUint32(t+4))<<BigInt(32)))}readFloat32(t){return Ps[0]=this.readInt32(t),wf[0]}readFloat64(t){return Ps[ga?0:1]=this.readInt32(t),Ps[ga?1:0]=this.readInt32(t+4),Ef[0]}writeInt8(t,e){this.bytes_[t]=e}writeUint8(t,e){this.bytes_[t]=e}writeInt16(t,e){this.bytes_[t]=e,this.bytes_[t+1]=e>>8}writeUint16(t,e){this.bytes_[t]=e,this.bytes_[t+1]=e>>8}writeInt32(t,e){this.bytes_[t]=e,this.bytes_[t+1]=e>>8,this.bytes_[t+2]=e>>16,this.bytes_[t+3]=e>>24}writeUint32(t,e){this.bytes_[t]=e,this.bytes_[t+1]=e>>8,this.bytes_[t+2]=e>>16,this.bytes_[t+3]=e>>24}writeInt64(t,e){this.writeInt32(t,Number(BigInt.asIntN(32,e))),this.writeInt32(t+4,Number(BigInt.asIntN(32,e>>BigInt(32))))}writeUint64(t,e){this.writeUint32(t,Number(BigInt.asUintN(32,e))),this.writeUint32(t+4,Number(BigInt.asUintN(32,e>>BigInt(32))))}writeFloat32(t,e){wf[0]=e,this.writeInt32(t,Ps[0])}writeFloat64(t,e){Ef[0]=e,this.writeInt32(t,Ps[ga?0:1]),this.writeInt32(t+4,Ps[ga?1:0])}getBufferIdentifier(){if(this.bytes_.length<this.position_+4+4)throw new Error("FlatBuffers: ByteBuffer is too short to contain an identifier.");let t="";for(let e=0;e<4;e++)t+=String.fromCharCode(this.readInt8(this.position_+4+e));return t}__offset(t,e){const n=t-this.readInt32(t);return e<this.readInt16(n)?this.readInt16(n+e):0}__union(t,e){return t.bb_pos=e+this.readInt32(e),t.bb=this,t}__string(t,e){t+=this.readInt32(t);const n=this.readInt32(t);t+=4;const s=this.bytes_.subarray(t,t+n);return e===ch.UTF8_BYTES?s:this.text_decoder_.decode(s)}__union_with_string(t,e){return typeof t=="string"?this.__string(e):this.__union(t,e)}__indirect(t){return t+this.readInt32(t)}__vector(t){return t+this.readInt32(t)+4}__vector_len(t){return this.readInt32(t+this.readInt32(t))}__has_identifier(t){if(t.length!=4)throw new Error("FlatBuffers: file identifier must be length 4");for(let e=0;e<4;e++)if(t.charCodeAt(e)!=this.readInt8(this.position()+4+e))return!1;return!0}createScalarList(t,e){const n=[];for(let s=0;s<e;++s)t(s)!==null&&n.push(t(s));return n}createObjList(t,e){const n=[];for(let s=0;s<e;++s){const r=t(s);r!==null&&n.push(r.unpack())}return n}}class _u{constructor(t){this.minalign=1,this.vtable=null,this.vtable_in_use=0,this.isNested=!1,this.object_start=0,this.vtables=[],this.vector_num_elems=0,this.force_defaults=!1,this.string_maps=null,this.text_encoder=new TextEncoder;let e;t?e=t:e=1024,this.bb=co.allocate(e),this.space=e}clear(){this.bb.clear(),this.space=this.bb.capacity(),this.minalign=1,this.vtable=null,this.vtable_in_use=0,this.isNested=!1,this.object_start=0,this.vtables=[],this.vector_num_elems=0,this.force_defaults=!1,this.string_maps=null}forceDefaults(t){this.force_defaults=t}dataBuffer(){return this.bb}asUint8Array(){return this.bb.bytes().subarray(this.bb.position(),this.bb.position()+this.offset())}prep(t,e){t>this.minalign&&(this.minalign=t);const n=~(this.bb.capacity()-this.space+e)+1&t-1;for(;this.space<n+t+e;){const s=this.bb.capacity();this.bb=_u.growByteBuffer(this.bb),this.space+=this.bb.capacity()-s}this.pad(n)}pad(t){for(let e=0;e<t;e++)this.bb.writeInt8(--this.space,0)}writeInt8(t){this.bb.writeInt8(this.space-=1,t)}writeInt16(t){this.bb.writeInt16(this.space-=2,t)}writeInt32(t){this.bb.writeInt32(this.space-=4,t)}writeInt64(t){this.bb.writeInt64(this.space-=8,t)}writeFloat32(t){this.bb.writeFloat32(this.space-=4,t)}writeFloat64(t){this.bb.writeFloat64(this.space-=8,t)}addInt8(t){this.prep(1,0),this.writeInt8(t)}addInt16(t){this.prep(2,0),this.writeInt16(t)}addInt32(t){this.prep(4,0),this.writeInt32(t)}addInt64(t){this.prep(8,0),this.writeInt64(t)}addFloat32(t){this.prep(4,0),this.writeFloat32(t)}addFloat64(t){this.prep(8,0),this.writeFloat64(t)}addFieldInt8(t,e,n){(this.force_defaults||e!=n)&&(this.addInt8(e),this.slot(t))}addFieldInt16(t,e,n){(this.force_defaults||e!=n)&&(this.addInt16(e),this.slot(t))}addFieldInt32(t,e,n){(this.force_defaults||e!=n)&&(this.addInt32(e),this.slot(t))}addFieldInt64(t,e,n){(this.force_defaults||e!==n)&&(this.addInt64(e),this.slot(t))}addFieldFloat32(t,e,n){(this.force_defaults||e!=n)&&(this.addFloat32(e),this.slot(t))}addFieldFloat64(t,e,n){(this.force_defaults||e!=n)&&(this.addFloat64(e),this.slot(t))}addFieldOffset(t,e,n){(this.force_defaults||e!=n)&&(this.addOffset(e),this.slot(t))}addFieldStruct(t,e,n){e!=n&&(this.nested(e),this.slot(t))}nested(t){if(t!=this.offset())throw new Error("FlatBuffers: struct must be serialized inline.")}notNested(){if(this.isNested)throw new Error("FlatBuffers: object serialization must not be nested.")}slot(t){this.vtable!==null&&(this.vtable[t]=this.offset())}offset(){return this.bb.capacity()-this.space}static growByteBuffer(t){const e=t.capacity();if(e&3221225472)throw new Error("FlatBuffers: cannot grow buffer beyond 2 gigabytes.");const n=e<<1,s=co.allocate(n);return s.setPosition(n-e),s.bytes().set(t.bytes(),n-e),s}addOffset(t){this.prep(4,0),this.writeInt32(this.offset()-t+4)}startObject(t){this.notNested(),this.vtable==null&&(this.vtable=[]),this.vtable_in_use=t;for(let e=0;e<t;e++)this.vtable[e]=0;this.isNested=!0,this.object_start=this.offset()}endObject(){if(this.vtable==null||!this.isNested)throw new Error("FlatBuffers: endObject called without startObject");this.addInt32(0);const t=this.offset();let e=this.vtable_in_use-1;for(;e>=0&&this.vtable[e]==0;e--);const n=e+1;for(;e>=0;e--)this.addInt16(this.vtable[e]!=0?t-this.vtable[e]:0);const s=2;this.addInt16(t-this.object_start);const r=(n+s)*2;this.addInt16(r);let o=0;const a=this.space;t:for(e=0;e<this.vtables.length;e++){const l=this.bb.capacity()-this.vtables[e];if(r==this.bb.readInt16(l)){for(let c=2;c<r;c+=2)if(this.bb.readInt16(a+c)!=this.bb.readInt16(l+c))continue t;o=this.vtables[e];break}}return o?(this.space=this.bb.capacity()-t,this.bb.writeInt32(this.space,o-t)):(this.vtables.push(this.offset()),this.bb.writeInt32(this.bb.capacity()-t,this.offset()-t)),this.isNested=!1,t}finish(t,e,n){const s=n?4:0;if(e){const r=e;if(this.prep(this.minalign,8+s),r.length!=4)throw new Error("FlatBuffers: file identifier must be length 4");for(let o=3;o>=0;o--)this.writeInt8(r.charCodeAt(o))}this.prep(this.minalign,4+s),this.addOffset(t),s&&this.addInt32(this.bb.capacity()-this.space),this.bb.setPosition(this.space)}finishSizePrefixed(t,e){this.finish(t,e,!0)}requiredField(t,e){const n=this.bb.capacity()-t,s=n-this.bb.readInt32(n);if(!(this.bb.readInt16(s+e)!=0))throw new Error("FlatBuffers: field "+e+" must be set")}startVector(t,e,n){this.notNested(),this.vector_num_elems=e,this.prep(4,t*e),this.prep(n,t*e)}endVector(){return this.writeInt32(this.vector_num_elems),this.offset()}createSharedString(t){if(!t)return 0;if(this.string_maps||(this.string_maps=new Map),this.string_maps.has(t))return this.string_maps.get(t);const e=this.createString(t);return this.string_maps.set(t,e),e}createString(t){if(t==null)return 0;let e;t instanceof Uint8Array?e=t:e=this.text_encoder.encode(t),this.addInt8(0),this.startVector(1,e.length,1),this.bb.setPosition(this.space-=e.length);for(let n=0,s=this.space,r=this.bb.bytes();n<e.length;n++)r[s++]=e[n];return this.endVector()}createObjectOffset(t){return t===null?0:typeof t=="string"?this.createString(t):t.pack(this)}createObjectOffsetList(t){const e=[];for(let n=0;n<t.length;++n){const s=t[n];if(s!==null)e.push(this.createObjectOffset(s));else throw new Error("FlatBuffers: Argument for createObjectOffsetList cannot contain null.")}return e}createStructOffsetList(t,e){return e(this,t.length),this.createObjectOffsetList(t.slice().reverse()),this.endVector()}}class Ni{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsAcknowledge(t,e){return(e||new Ni).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsAcknowledge(t,e){return t.setPosition(t.position()+4),(e||new Ni).__init(t.readInt32(t.position())+t.position(),t)}needle(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint32(this.bb_pos+t):0}fault(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}faultNumber(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readUint32(this.bb_pos+t):0}timeNs(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.readInt64(this.bb_pos+t):BigInt("0")}static startAcknowledge(t){t.startObject(4)}static addNeedle(t,e){t.addFieldInt32(0,e,0)}static addFault(t,e){t.addFieldOffset(1,e,0)}static addFaultNumber(t,e){t.addFieldInt32(2,e,0)}static addTimeNs(t,e){t.addFieldInt64(3,e,BigInt("0"))}static endAcknowledge(t){return t.endObject()}static createAcknowledge(t,e,n,s,r){return Ni.startAcknowledge(t),Ni.addNeedle(t,e),Ni.addFault(t,n),Ni.addFaultNumber(t,s),Ni.addTimeNs(t,r),Ni.endAcknowledge(t)}}var hh=(i=>(i[i.Ready=0]="Ready",i[i.Running=1]="Running",i[i.Paused=2]="Paused",i[i.Ended=3]="Ended",i[i.Playback=4]="Playback",i))(hh||{});class Qi{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsAskRows(t,e){return(e||new Qi).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsAskRows(t,e){return t.setPosition(t.position()+4),(e||new Qi).__init(t.readInt32(t.position())+t.position(),t)}first(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}last(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}points(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readUint32(this.bb_pos+t):0}static startAskRows(t){t.startObject(3)}static addFirst(t,e){t.addFieldInt64(0,e,BigInt("0"))}static addLast(t,e){t.addFieldInt64(1,e,BigInt("0"))}static addPoints(t,e){t.addFieldInt32(2,e,0)}static endAskRows(t){return t.endObject()}static createAskRows(t,e,n,s){return Qi.startAskRows(t),Qi.addFirst(t,e),Qi.addLast(t,n),Qi.addPoints(t,s),Qi.endAskRows(t)}}class Qs{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsChoose(t,e){return(e||new Qs).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsChoose(t,e){return t.setPosition(t.position()+4),(e||new Qs).__init(t.readInt32(t.position())+t.position(),t)}scene(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}static startChoose(t){t.startObject(1)}static addScene(t,e){t.addFieldOffset(0,e,0)}static endChoose(t){return t.endObject()}static createChoose(t,e){return Qs.startChoose(t),Qs.addScene(t,e),Qs.endChoose(t)}}class Zr{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsEnd(t,e){return(e||new Zr).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsEnd(t,e){return t.setPosition(t.position()+4),(e||new Zr).__init(t.readInt32(t.position())+t.position(),t)}static startEnd(t){t.startObject(0)}static endEnd(t){return t.endObject()}static createEnd(t){return Zr.startEnd(t),Zr.endEnd(t)}}class Kp{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}tick(){return this.bb.readUint64(this.bb_pos)}kind(){return this.bb.readUint32(this.bb_pos+8)}needle(){return this.bb.readUint32(this.bb_pos+12)}layer(){return this.bb.readUint32(this.bb_pos+16)}depthM(){return this.bb.readFloat32(this.bb_pos+20)}forceN(){return this.bb.readFloat32(this.bb_pos+24)}static sizeOf(){return 32}static createHappened(t,e,n,s,r,o,a){return t.prep(8,32),t.pad(4),t.writeFloat32(a),t.writeFloat32(o),t.writeInt32(r),t.writeInt32(s),t.writeInt32(n),t.writeInt64(e),t.offset()}}var uh=(i=>(i[i.Free=0]="Free",i[i.Contact=1]="Contact",i[i.Inserted=2]="Inserted",i[i.Retracting=3]="Retracting",i))(uh||{});let Dl=class{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}w(){return this.bb.readFloat32(this.bb_pos)}x(){return this.bb.readFloat32(this.bb_pos+4)}y(){return this.bb.readFloat32(this.bb_pos+8)}z(){return this.bb.readFloat32(this.bb_pos+12)}static sizeOf(){return 16}static createQuaternion(t,e,n,s,r){return t.prep(4,16),t.writeFloat32(r),t.writeFloat32(s),t.writeFloat32(n),t.writeFloat32(e),t.offset()}};class we{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}x(){return this.bb.readFloat32(this.bb_pos)}y(){return this.bb.readFloat32(this.bb_pos+4)}z(){return this.bb.readFloat32(this.bb_pos+8)}static sizeOf(){return 12}static createVec3(t,e,n,s){return t.prep(4,12),t.writeFloat32(s),t.writeFloat32(n),t.writeFloat32(e),t.offset()}}class hl{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsNeedleFrame(t,e){return(e||new hl).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsNeedleFrame(t,e){return t.setPosition(t.position()+4),(e||new hl).__init(t.readInt32(t.position())+t.position(),t)}nodesM(t,e){const n=this.bb.__offset(this.bb_pos,4);return n?(e||new we).__init(this.bb.__vector(this.bb_pos+n)+t*12,this.bb):null}nodesMLength(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.__vector_len(this.bb_pos+t):0}handlePositionM(t){const e=this.bb.__offset(this.bb_pos,6);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}handleRotation(t){const e=this.bb.__offset(this.bb_pos,8);return e?(t||new Dl).__init(this.bb_pos+e,this.bb):null}tipM(t){const e=this.bb.__offset(this.bb_pos,10);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}depthM(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readFloat32(this.bb_pos+t):0}phase(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readUint8(this.bb_pos+t):uh.Free}layer(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.readUint32(this.bb_pos+t):0}forceN(t){const e=this.bb.__offset(this.bb_pos,18);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}commandN(t){const e=this.bb.__offset(this.bb_pos,20);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}stiffnessN(t){const e=this.bb.__offset(this.bb_pos,22);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}cuttingN(t){const e=this.bb.__offset(this.bb_pos,24);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}frictionN(t){const e=this.bb.__offset(this.bb_pos,26);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}clampingN(t){const e=this.bb.__offset(this.bb_pos,28);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}obstacleN(t){const e=this.bb.__offset(this.bb_pos,30);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}fault(t){const e=this.bb.__offset(this.bb_pos,32);return e?this.bb.__string(this.bb_pos+e,t):null}guard(t){const e=this.bb.__offset(this.bb_pos,34);return e?this.bb.__string(this.bb_pos+e,t):null}flags(){const t=this.bb.__offset(this.bb_pos,36);return t?this.bb.readUint32(this.bb_pos+t):0}faultNumber(){const t=this.bb.__offset(this.bb_pos,38);return t?this.bb.readUint32(this.bb_pos+t):0}static startNeedleFrame(t){t.startObject(18)}static addNodesM(t,e){t.addFieldOffset(0,e,0)}static startNodesMVector(t,e){t.startVector(12,e,4)}static addHandlePositionM(t,e){t.addFieldStruct(1,e,0)}static addHandleRotation(t,e){t.addFieldStruct(2,e,0)}static addTipM(t,e){t.addFieldStruct(3,e,0)}static addDepthM(t,e){t.addFieldFloat32(4,e,0)}static addPhase(t,e){t.addFieldInt8(5,e,uh.Free)}static addLayer(t,e){t.addFieldInt32(6,e,0)}static addForceN(t,e){t.addFieldStruct(7,e,0)}static addCommandN(t,e){t.addFieldStruct(8,e,0)}static addStiffnessN(t,e){t.addFieldStruct(9,e,0)}static addCuttingN(t,e){t.addFieldStruct(10,e,0)}static addFrictionN(t,e){t.addFieldStruct(11,e,0)}static addClampingN(t,e){t.addFieldStruct(12,e,0)}static addObstacleN(t,e){t.addFieldStruct(13,e,0)}static addFault(t,e){t.addFieldOffset(14,e,0)}static addGuard(t,e){t.addFieldOffset(15,e,0)}static addFlags(t,e){t.addFieldInt32(16,e,0)}static addFaultNumber(t,e){t.addFieldInt32(17,e,0)}static endNeedleFrame(t){return t.endObject()}}class pg{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}positionM(t){return(t||new we).__init(this.bb_pos,this.bb)}goalM(t){return(t||new we).__init(this.bb_pos+12,this.bb)}forceN(t){return(t||new we).__init(this.bb_pos+24,this.bb)}needle(){return this.bb.readUint32(this.bb_pos+36)}static sizeOf(){return 40}static createParticle(t,e,n,s,r,o,a,l,c,h,f){return t.prep(4,40),t.writeInt32(f),t.prep(4,12),t.writeFloat32(h),t.writeFloat32(c),t.writeFloat32(l),t.prep(4,12),t.writeFloat32(a),t.writeFloat32(o),t.writeFloat32(r),t.prep(4,12),t.writeFloat32(s),t.writeFloat32(n),t.writeFloat32(e),t.offset()}}class gu{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}tick(){return this.bb.readUint64(this.bb_pos)}depthM(){return this.bb.readFloat32(this.bb_pos+8)}travelM(){return this.bb.readFloat32(this.bb_pos+12)}forceN(){return this.bb.readFloat32(this.bb_pos+16)}lateralN(){return this.bb.readFloat32(this.bb_pos+20)}stiffnessN(){return this.bb.readFloat32(this.bb_pos+24)}cuttingN(){return this.bb.readFloat32(this.bb_pos+28)}frictionN(){return this.bb.readFloat32(this.bb_pos+32)}clampingN(){return this.bb.readFloat32(this.bb_pos+36)}obstacleN(){return this.bb.readFloat32(this.bb_pos+40)}tickUs(){return this.bb.readFloat32(this.bb_pos+44)}lateUs(){return this.bb.readFloat32(this.bb_pos+48)}needle(){return this.bb.readUint32(this.bb_pos+52)}static sizeOf(){return 56}static createRow(t,e,n,s,r,o,a,l,c,h,f,u,p,_){return t.prep(8,56),t.writeInt32(_),t.writeFloat32(p),t.writeFloat32(u),t.writeFloat32(f),t.writeFloat32(h),t.writeFloat32(c),t.writeFloat32(l),t.writeFloat32(a),t.writeFloat32(o),t.writeFloat32(r),t.writeFloat32(s),t.writeFloat32(n),t.writeInt64(e),t.offset()}}class An{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsTiming(t,e){return(e||new An).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsTiming(t,e){return t.setPosition(t.position()+4),(e||new An).__init(t.readInt32(t.position())+t.position(),t)}ticks(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}missed(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}lostRecords(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}lostFrames(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}connections(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readUint32(this.bb_pos+t):0}tickUs(t){const e=this.bb.__offset(this.bb_pos,14);return e?this.bb.readFloat32(this.bb.__vector(this.bb_pos+e)+t*4):0}tickUsLength(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.__vector_len(this.bb_pos+t):0}tickUsArray(){const t=this.bb.__offset(this.bb_pos,14);return t?new Float32Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}lateUs(t){const e=this.bb.__offset(this.bb_pos,16);return e?this.bb.readFloat32(this.bb.__vector(this.bb_pos+e)+t*4):0}lateUsLength(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.__vector_len(this.bb_pos+t):0}lateUsArray(){const t=this.bb.__offset(this.bb_pos,16);return t?new Float32Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}tickBins(t){const e=this.bb.__offset(this.bb_pos,18);return e?this.bb.readUint32(this.bb.__vector(this.bb_pos+e)+t*4):0}tickBinsLength(){const t=this.bb.__offset(this.bb_pos,18);return t?this.bb.__vector_len(this.bb_pos+t):0}tickBinsArray(){const t=this.bb.__offset(this.bb_pos,18);return t?new Uint32Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}lateBins(t){const e=this.bb.__offset(this.bb_pos,20);return e?this.bb.readUint32(this.bb.__vector(this.bb_pos+e)+t*4):0}lateBinsLength(){const t=this.bb.__offset(this.bb_pos,20);return t?this.bb.__vector_len(this.bb_pos+t):0}lateBinsArray(){const t=this.bb.__offset(this.bb_pos,20);return t?new Uint32Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}binUs(){const t=this.bb.__offset(this.bb_pos,22);return t?this.bb.readFloat32(this.bb_pos+t):0}static startTiming(t){t.startObject(10)}static addTicks(t,e){t.addFieldInt64(0,e,BigInt("0"))}static addMissed(t,e){t.addFieldInt64(1,e,BigInt("0"))}static addLostRecords(t,e){t.addFieldInt64(2,e,BigInt("0"))}static addLostFrames(t,e){t.addFieldInt64(3,e,BigInt("0"))}static addConnections(t,e){t.addFieldInt32(4,e,0)}static addTickUs(t,e){t.addFieldOffset(5,e,0)}static createTickUsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addFloat32(e[n]);return t.endVector()}static startTickUsVector(t,e){t.startVector(4,e,4)}static addLateUs(t,e){t.addFieldOffset(6,e,0)}static createLateUsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addFloat32(e[n]);return t.endVector()}static startLateUsVector(t,e){t.startVector(4,e,4)}static addTickBins(t,e){t.addFieldOffset(7,e,0)}static createTickBinsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addInt32(e[n]);return t.endVector()}static startTickBinsVector(t,e){t.startVector(4,e,4)}static addLateBins(t,e){t.addFieldOffset(8,e,0)}static createLateBinsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addInt32(e[n]);return t.endVector()}static startLateBinsVector(t,e){t.startVector(4,e,4)}static addBinUs(t,e){t.addFieldFloat32(9,e,0)}static endTiming(t){return t.endObject()}static createTiming(t,e,n,s,r,o,a,l,c,h,f){return An.startTiming(t),An.addTicks(t,e),An.addMissed(t,n),An.addLostRecords(t,s),An.addLostFrames(t,r),An.addConnections(t,o),An.addTickUs(t,a),An.addLateUs(t,l),An.addTickBins(t,c),An.addLateBins(t,h),An.addBinUs(t,f),An.endTiming(t)}}class mg{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}positionM(t){return(t||new we).__init(this.bb_pos,this.bb)}forceN(t){return(t||new we).__init(this.bb_pos+12,this.bb)}needle(){return this.bb.readUint32(this.bb_pos+24)}static sizeOf(){return 28}static createTouch(t,e,n,s,r,o,a,l){return t.prep(4,28),t.writeInt32(l),t.prep(4,12),t.writeFloat32(a),t.writeFloat32(o),t.writeFloat32(r),t.prep(4,12),t.writeFloat32(s),t.writeFloat32(n),t.writeFloat32(e),t.offset()}}class ul{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsFrame(t,e){return(e||new ul).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsFrame(t,e){return t.setPosition(t.position()+4),(e||new ul).__init(t.readInt32(t.position())+t.position(),t)}tick(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}activity(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.readUint8(this.bb_pos+t):hh.Ready}key(){const t=this.bb.__offset(this.bb_pos,8);return t?!!this.bb.readInt8(this.bb_pos+t):!1}movedIndex(t){const e=this.bb.__offset(this.bb_pos,10);return e?this.bb.readUint32(this.bb.__vector(this.bb_pos+e)+t*4):0}movedIndexLength(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.__vector_len(this.bb_pos+t):0}movedIndexArray(){const t=this.bb.__offset(this.bb_pos,10);return t?new Uint32Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}movedTo(t){const e=this.bb.__offset(this.bb_pos,12);return e?this.bb.readInt16(this.bb.__vector(this.bb_pos+e)+t*2):0}movedToLength(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.__vector_len(this.bb_pos+t):0}movedToArray(){const t=this.bb.__offset(this.bb_pos,12);return t?new Int16Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}needles(t,e){const n=this.bb.__offset(this.bb_pos,14);return n?(e||new hl).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}needlesLength(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.__vector_len(this.bb_pos+t):0}particles(t,e){const n=this.bb.__offset(this.bb_pos,16);return n?(e||new pg).__init(this.bb.__vector(this.bb_pos+n)+t*40,this.bb):null}particlesLength(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.__vector_len(this.bb_pos+t):0}touches(t,e){const n=this.bb.__offset(this.bb_pos,18);return n?(e||new mg).__init(this.bb.__vector(this.bb_pos+n)+t*28,this.bb):null}touchesLength(){const t=this.bb.__offset(this.bb_pos,18);return t?this.bb.__vector_len(this.bb_pos+t):0}events(t,e){const n=this.bb.__offset(this.bb_pos,20);return n?(e||new Kp).__init(this.bb.__vector(this.bb_pos+n)+t*32,this.bb):null}eventsLength(){const t=this.bb.__offset(this.bb_pos,20);return t?this.bb.__vector_len(this.bb_pos+t):0}rows(t,e){const n=this.bb.__offset(this.bb_pos,22);return n?(e||new gu).__init(this.bb.__vector(this.bb_pos+n)+t*56,this.bb):null}rowsLength(){const t=this.bb.__offset(this.bb_pos,22);return t?this.bb.__vector_len(this.bb_pos+t):0}timing(t){const e=this.bb.__offset(this.bb_pos,24);return e?(t||new An).__init(this.bb.__indirect(this.bb_pos+e),this.bb):null}attempt(){const t=this.bb.__offset(this.bb_pos,26);return t?this.bb.readUint32(this.bb_pos+t):0}timeNs(){const t=this.bb.__offset(this.bb_pos,28);return t?this.bb.readInt64(this.bb_pos+t):BigInt("0")}static startFrame(t){t.startObject(13)}static addTick(t,e){t.addFieldInt64(0,e,BigInt("0"))}static addActivity(t,e){t.addFieldInt8(1,e,hh.Ready)}static addKey(t,e){t.addFieldInt8(2,+e,0)}static addMovedIndex(t,e){t.addFieldOffset(3,e,0)}static createMovedIndexVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addInt32(e[n]);return t.endVector()}static startMovedIndexVector(t,e){t.startVector(4,e,4)}static addMovedTo(t,e){t.addFieldOffset(4,e,0)}static createMovedToVector(t,e){t.startVector(2,e.length,2);for(let n=e.length-1;n>=0;n--)t.addInt16(e[n]);return t.endVector()}static startMovedToVector(t,e){t.startVector(2,e,2)}static addNeedles(t,e){t.addFieldOffset(5,e,0)}static createNeedlesVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startNeedlesVector(t,e){t.startVector(4,e,4)}static addParticles(t,e){t.addFieldOffset(6,e,0)}static startParticlesVector(t,e){t.startVector(40,e,4)}static addTouches(t,e){t.addFieldOffset(7,e,0)}static startTouchesVector(t,e){t.startVector(28,e,4)}static addEvents(t,e){t.addFieldOffset(8,e,0)}static startEventsVector(t,e){t.startVector(32,e,8)}static addRows(t,e){t.addFieldOffset(9,e,0)}static startRowsVector(t,e){t.startVector(56,e,8)}static addTiming(t,e){t.addFieldOffset(10,e,0)}static addAttempt(t,e){t.addFieldInt32(11,e,0)}static addTimeNs(t,e){t.addFieldInt64(12,e,BigInt("0"))}static endFrame(t){return t.endObject()}}class fl{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsNeedleInfo(t,e){return(e||new fl).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsNeedleInfo(t,e){return t.setPosition(t.position()+4),(e||new fl).__init(t.readInt32(t.position())+t.position(),t)}device(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}lengthM(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.readFloat32(this.bb_pos+t):0}outerRadiusM(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readFloat32(this.bb_pos+t):0}entryM(t){const e=this.bb.__offset(this.bb_pos,10);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}direction(t){const e=this.bb.__offset(this.bb_pos,12);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}maxForceN(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readFloat32(this.bb_pos+t):0}static startNeedleInfo(t){t.startObject(6)}static addDevice(t,e){t.addFieldOffset(0,e,0)}static addLengthM(t,e){t.addFieldFloat32(1,e,0)}static addOuterRadiusM(t,e){t.addFieldFloat32(2,e,0)}static addEntryM(t,e){t.addFieldStruct(3,e,0)}static addDirection(t,e){t.addFieldStruct(4,e,0)}static addMaxForceN(t,e){t.addFieldFloat32(5,e,0)}static endNeedleInfo(t){return t.endObject()}}class dl{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsObstacle(t,e){return(e||new dl).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsObstacle(t,e){return t.setPosition(t.position()+4),(e||new dl).__init(t.readInt32(t.position())+t.position(),t)}positionM(t){const e=this.bb.__offset(this.bb_pos,4);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}rotation(t){const e=this.bb.__offset(this.bb_pos,6);return e?(t||new Dl).__init(this.bb_pos+e,this.bb):null}verticesM(t,e){const n=this.bb.__offset(this.bb_pos,8);return n?(e||new we).__init(this.bb.__vector(this.bb_pos+n)+t*12,this.bb):null}verticesMLength(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.__vector_len(this.bb_pos+t):0}roundingM(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.readFloat32(this.bb_pos+t):0}static startObstacle(t){t.startObject(4)}static addPositionM(t,e){t.addFieldStruct(0,e,0)}static addRotation(t,e){t.addFieldStruct(1,e,0)}static addVerticesM(t,e){t.addFieldOffset(2,e,0)}static startVerticesMVector(t,e){t.startVector(12,e,4)}static addRoundingM(t,e){t.addFieldFloat32(3,e,0)}static endObstacle(t){return t.endObject()}}class pl{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsTarget(t,e){return(e||new pl).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsTarget(t,e){return t.setPosition(t.position()+4),(e||new pl).__init(t.readInt32(t.position())+t.position(),t)}name(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}positionM(t){const e=this.bb.__offset(this.bb_pos,6);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}radiusM(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readFloat32(this.bb_pos+t):0}forbidden(){const t=this.bb.__offset(this.bb_pos,10);return t?!!this.bb.readInt8(this.bb_pos+t):!1}static startTarget(t){t.startObject(4)}static addName(t,e){t.addFieldOffset(0,e,0)}static addPositionM(t,e){t.addFieldStruct(1,e,0)}static addRadiusM(t,e){t.addFieldFloat32(2,e,0)}static addForbidden(t,e){t.addFieldInt8(3,+e,0)}static endTarget(t){return t.endObject()}}class qe{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsHello(t,e){return(e||new qe).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsHello(t,e){return t.setPosition(t.position()+4),(e||new qe).__init(t.readInt32(t.position())+t.position(),t)}protocol(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint32(this.bb_pos+t):0}styletVersion(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}scene(t){const e=this.bb.__offset(this.bb_pos,8);return e?this.bb.__string(this.bb_pos+e,t):null}scenes(t,e){const n=this.bb.__offset(this.bb_pos,10);return n?this.bb.__string(this.bb.__vector(this.bb_pos+n)+t*4,e):null}scenesLength(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.__vector_len(this.bb_pos+t):0}periodS(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readFloat32(this.bb_pos+t):0}recordingTicks(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}voxelEdgeM(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.readFloat32(this.bb_pos+t):0}particles(){const t=this.bb.__offset(this.bb_pos,18);return t?this.bb.readUint32(this.bb_pos+t):0}restM(t,e){const n=this.bb.__offset(this.bb_pos,20);return n?(e||new we).__init(this.bb.__vector(this.bb_pos+n)+t*12,this.bb):null}restMLength(){const t=this.bb.__offset(this.bb_pos,20);return t?this.bb.__vector_len(this.bb_pos+t):0}corners(t){const e=this.bb.__offset(this.bb_pos,22);return e?this.bb.readUint32(this.bb.__vector(this.bb_pos+e)+t*4):0}cornersLength(){const t=this.bb.__offset(this.bb_pos,22);return t?this.bb.__vector_len(this.bb_pos+t):0}cornersArray(){const t=this.bb.__offset(this.bb_pos,22);return t?new Uint32Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}positionUnitM(){const t=this.bb.__offset(this.bb_pos,24);return t?this.bb.readFloat32(this.bb_pos+t):0}needles(t,e){const n=this.bb.__offset(this.bb_pos,26);return n?(e||new fl).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}needlesLength(){const t=this.bb.__offset(this.bb_pos,26);return t?this.bb.__vector_len(this.bb_pos+t):0}obstacles(t,e){const n=this.bb.__offset(this.bb_pos,28);return n?(e||new dl).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}obstaclesLength(){const t=this.bb.__offset(this.bb_pos,28);return t?this.bb.__vector_len(this.bb_pos+t):0}targets(t,e){const n=this.bb.__offset(this.bb_pos,30);return n?(e||new pl).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}targetsLength(){const t=this.bb.__offset(this.bb_pos,30);return t?this.bb.__vector_len(this.bb_pos+t):0}mayControl(){const t=this.bb.__offset(this.bb_pos,32);return t?!!this.bb.readInt8(this.bb_pos+t):!1}static startHello(t){t.startObject(15)}static addProtocol(t,e){t.addFieldInt32(0,e,0)}static addStyletVersion(t,e){t.addFieldOffset(1,e,0)}static addScene(t,e){t.addFieldOffset(2,e,0)}static addScenes(t,e){t.addFieldOffset(3,e,0)}static createScenesVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startScenesVector(t,e){t.startVector(4,e,4)}static addPeriodS(t,e){t.addFieldFloat32(4,e,0)}static addRecordingTicks(t,e){t.addFieldInt64(5,e,BigInt("0"))}static addVoxelEdgeM(t,e){t.addFieldFloat32(6,e,0)}static addParticles(t,e){t.addFieldInt32(7,e,0)}static addRestM(t,e){t.addFieldOffset(8,e,0)}static startRestMVector(t,e){t.startVector(12,e,4)}static addCorners(t,e){t.addFieldOffset(9,e,0)}static createCornersVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addInt32(e[n]);return t.endVector()}static startCornersVector(t,e){t.startVector(4,e,4)}static addPositionUnitM(t,e){t.addFieldFloat32(10,e,0)}static addNeedles(t,e){t.addFieldOffset(11,e,0)}static createNeedlesVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startNeedlesVector(t,e){t.startVector(4,e,4)}static addObstacles(t,e){t.addFieldOffset(12,e,0)}static createObstaclesVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startObstaclesVector(t,e){t.startVector(4,e,4)}static addTargets(t,e){t.addFieldOffset(13,e,0)}static createTargetsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startTargetsVector(t,e){t.startVector(4,e,4)}static addMayControl(t,e){t.addFieldInt8(14,+e,0)}static endHello(t){return t.endObject()}static createHello(t,e,n,s,r,o,a,l,c,h,f,u,p,_,b,m){return qe.startHello(t),qe.addProtocol(t,e),qe.addStyletVersion(t,n),qe.addScene(t,s),qe.addScenes(t,r),qe.addPeriodS(t,o),qe.addRecordingTicks(t,a),qe.addVoxelEdgeM(t,l),qe.addParticles(t,c),qe.addRestM(t,h),qe.addCorners(t,f),qe.addPositionUnitM(t,u),qe.addNeedles(t,p),qe.addObstacles(t,_),qe.addTargets(t,b),qe.addMayControl(t,m),qe.endHello(t)}}class tr{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsMark(t,e){return(e||new tr).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsMark(t,e){return t.setPosition(t.position()+4),(e||new tr).__init(t.readInt32(t.position())+t.position(),t)}text(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}static startMark(t){t.startObject(1)}static addText(t,e){t.addFieldOffset(0,e,0)}static endMark(t){return t.endObject()}static createMark(t,e){return tr.startMark(t),tr.addText(t,e),tr.endMark(t)}}class ts{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsMarked(t,e){return(e||new ts).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsMarked(t,e){return t.setPosition(t.position()+4),(e||new ts).__init(t.readInt32(t.position())+t.position(),t)}tick(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}text(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}attempt(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readUint32(this.bb_pos+t):0}static startMarked(t){t.startObject(3)}static addTick(t,e){t.addFieldInt64(0,e,BigInt("0"))}static addText(t,e){t.addFieldOffset(1,e,0)}static addAttempt(t,e){t.addFieldInt32(2,e,0)}static endMarked(t){return t.endObject()}static createMarked(t,e,n,s){return ts.startMarked(t),ts.addTick(t,e),ts.addText(t,n),ts.addAttempt(t,s),ts.endMarked(t)}}class Kr{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsPause(t,e){return(e||new Kr).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsPause(t,e){return t.setPosition(t.position()+4),(e||new Kr).__init(t.readInt32(t.position())+t.position(),t)}static startPause(t){t.startObject(0)}static endPause(t){return t.endObject()}static createPause(t){return Kr.startPause(t),Kr.endPause(t)}}class er{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsPlay(t,e){return(e||new er).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsPlay(t,e){return t.setPosition(t.position()+4),(e||new er).__init(t.readInt32(t.position())+t.position(),t)}speed(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readFloat32(this.bb_pos+t):0}static startPlay(t){t.startObject(1)}static addSpeed(t,e){t.addFieldFloat32(0,e,0)}static endPlay(t){return t.endObject()}static createPlay(t,e){return er.startPlay(t),er.addSpeed(t,e),er.endPlay(t)}}class as{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsPointer(t,e){return(e||new as).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsPointer(t,e){return t.setPosition(t.position()+4),(e||new as).__init(t.readInt32(t.position())+t.position(),t)}needle(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint32(this.bb_pos+t):0}positionM(t){const e=this.bb.__offset(this.bb_pos,6);return e?(t||new we).__init(this.bb_pos+e,this.bb):null}rotation(t){const e=this.bb.__offset(this.bb_pos,8);return e?(t||new Dl).__init(this.bb_pos+e,this.bb):null}buttons(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.readUint32(this.bb_pos+t):0}static startPointer(t){t.startObject(4)}static addNeedle(t,e){t.addFieldInt32(0,e,0)}static addPositionM(t,e){t.addFieldStruct(1,e,0)}static addRotation(t,e){t.addFieldStruct(2,e,0)}static addButtons(t,e){t.addFieldInt32(3,e,0)}static endPointer(t){return t.endObject()}}class nr{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsRefused(t,e){return(e||new nr).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsRefused(t,e){return t.setPosition(t.position()+4),(e||new nr).__init(t.readInt32(t.position())+t.position(),t)}what(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}static startRefused(t){t.startObject(1)}static addWhat(t,e){t.addFieldOffset(0,e,0)}static endRefused(t){return t.endObject()}static createRefused(t,e){return nr.startRefused(t),nr.addWhat(t,e),nr.endRefused(t)}}class Jr{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsReset(t,e){return(e||new Jr).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsReset(t,e){return t.setPosition(t.position()+4),(e||new Jr).__init(t.readInt32(t.position())+t.position(),t)}static startReset(t){t.startObject(0)}static endReset(t){return t.endObject()}static createReset(t){return Jr.startReset(t),Jr.endReset(t)}}class Qr{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsResume(t,e){return(e||new Qr).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsResume(t,e){return t.setPosition(t.position()+4),(e||new Qr).__init(t.readInt32(t.position())+t.position(),t)}static startResume(t){t.startObject(0)}static endResume(t){return t.endObject()}static createResume(t){return Qr.startResume(t),Qr.endResume(t)}}class Oi{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsRows(t,e){return(e||new Oi).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsRows(t,e){return t.setPosition(t.position()+4),(e||new Oi).__init(t.readInt32(t.position())+t.position(),t)}first(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}stride(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.readUint32(this.bb_pos+t):0}rows(t,e){const n=this.bb.__offset(this.bb_pos,8);return n?(e||new gu).__init(this.bb.__vector(this.bb_pos+n)+t*56,this.bb):null}rowsLength(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.__vector_len(this.bb_pos+t):0}events(t,e){const n=this.bb.__offset(this.bb_pos,10);return n?(e||new Kp).__init(this.bb.__vector(this.bb_pos+n)+t*32,this.bb):null}eventsLength(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.__vector_len(this.bb_pos+t):0}static startRows(t){t.startObject(4)}static addFirst(t,e){t.addFieldInt64(0,e,BigInt("0"))}static addStride(t,e){t.addFieldInt32(1,e,0)}static addRows(t,e){t.addFieldOffset(2,e,0)}static startRowsVector(t,e){t.startVector(56,e,8)}static addEvents(t,e){t.addFieldOffset(3,e,0)}static startEventsVector(t,e){t.startVector(32,e,8)}static endRows(t){return t.endObject()}static createRows(t,e,n,s,r){return Oi.startRows(t),Oi.addFirst(t,e),Oi.addStride(t,n),Oi.addRows(t,s),Oi.addEvents(t,r),Oi.endRows(t)}}class es{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsPunctureScore(t,e){return(e||new es).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsPunctureScore(t,e){return t.setPosition(t.position()+4),(e||new es).__init(t.readInt32(t.position())+t.position(),t)}tick(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}layer(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}forceN(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readFloat32(this.bb_pos+t):0}static startPunctureScore(t){t.startObject(3)}static addTick(t,e){t.addFieldInt64(0,e,BigInt("0"))}static addLayer(t,e){t.addFieldOffset(1,e,0)}static addForceN(t,e){t.addFieldFloat32(2,e,0)}static endPunctureScore(t){return t.endObject()}static createPunctureScore(t,e,n,s){return es.startPunctureScore(t),es.addTick(t,e),es.addLayer(t,n),es.addForceN(t,s),es.endPunctureScore(t)}}class ki{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsTargetScore(t,e){return(e||new ki).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsTargetScore(t,e){return t.setPosition(t.position()+4),(e||new ki).__init(t.readInt32(t.position())+t.position(),t)}name(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}forbidden(){const t=this.bb.__offset(this.bb_pos,6);return t?!!this.bb.readInt8(this.bb_pos+t):!1}closestM(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readFloat32(this.bb_pos+t):0}reached(){const t=this.bb.__offset(this.bb_pos,10);return t?!!this.bb.readInt8(this.bb_pos+t):!1}static startTargetScore(t){t.startObject(4)}static addName(t,e){t.addFieldOffset(0,e,0)}static addForbidden(t,e){t.addFieldInt8(1,+e,0)}static addClosestM(t,e){t.addFieldFloat32(2,e,0)}static addReached(t,e){t.addFieldInt8(3,+e,0)}static endTargetScore(t){return t.endObject()}static createTargetScore(t,e,n,s,r){return ki.startTargetScore(t),ki.addName(t,e),ki.addForbidden(t,n),ki.addClosestM(t,s),ki.addReached(t,r),ki.endTargetScore(t)}}class Xe{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsScore(t,e){return(e||new Xe).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsScore(t,e){return t.setPosition(t.position()+4),(e||new Xe).__init(t.readInt32(t.position())+t.position(),t)}attempt(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint32(this.bb_pos+t):0}scene(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}trainee(t){const e=this.bb.__offset(this.bb_pos,8);return e?this.bb.__string(this.bb_pos+e,t):null}began(t){const e=this.bb.__offset(this.bb_pos,10);return e?this.bb.__string(this.bb_pos+e,t):null}durationS(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readFloat32(this.bb_pos+t):0}pathM(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readFloat32(this.bb_pos+t):0}depthPathM(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.readFloat32(this.bb_pos+t):0}punctures(t,e){const n=this.bb.__offset(this.bb_pos,18);return n?(e||new es).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}puncturesLength(){const t=this.bb.__offset(this.bb_pos,18);return t?this.bb.__vector_len(this.bb_pos+t):0}withdrawals(){const t=this.bb.__offset(this.bb_pos,20);return t?this.bb.readUint32(this.bb_pos+t):0}targets(t,e){const n=this.bb.__offset(this.bb_pos,22);return n?(e||new ki).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}targetsLength(){const t=this.bb.__offset(this.bb_pos,22);return t?this.bb.__vector_len(this.bb_pos+t):0}peakForceN(){const t=this.bb.__offset(this.bb_pos,24);return t?this.bb.readFloat32(this.bb_pos+t):0}peakLateralN(){const t=this.bb.__offset(this.bb_pos,26);return t?this.bb.readFloat32(this.bb_pos+t):0}meanForceN(){const t=this.bb.__offset(this.bb_pos,28);return t?this.bb.readFloat32(this.bb_pos+t):0}faults(){const t=this.bb.__offset(this.bb_pos,30);return t?this.bb.readUint32(this.bb_pos+t):0}recording(t){const e=this.bb.__offset(this.bb_pos,32);return e?this.bb.__string(this.bb_pos+e,t):null}rows(t,e){const n=this.bb.__offset(this.bb_pos,34);return n?(e||new gu).__init(this.bb.__vector(this.bb_pos+n)+t*56,this.bb):null}rowsLength(){const t=this.bb.__offset(this.bb_pos,34);return t?this.bb.__vector_len(this.bb_pos+t):0}static startScore(t){t.startObject(16)}static addAttempt(t,e){t.addFieldInt32(0,e,0)}static addScene(t,e){t.addFieldOffset(1,e,0)}static addTrainee(t,e){t.addFieldOffset(2,e,0)}static addBegan(t,e){t.addFieldOffset(3,e,0)}static addDurationS(t,e){t.addFieldFloat32(4,e,0)}static addPathM(t,e){t.addFieldFloat32(5,e,0)}static addDepthPathM(t,e){t.addFieldFloat32(6,e,0)}static addPunctures(t,e){t.addFieldOffset(7,e,0)}static createPuncturesVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startPuncturesVector(t,e){t.startVector(4,e,4)}static addWithdrawals(t,e){t.addFieldInt32(8,e,0)}static addTargets(t,e){t.addFieldOffset(9,e,0)}static createTargetsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startTargetsVector(t,e){t.startVector(4,e,4)}static addPeakForceN(t,e){t.addFieldFloat32(10,e,0)}static addPeakLateralN(t,e){t.addFieldFloat32(11,e,0)}static addMeanForceN(t,e){t.addFieldFloat32(12,e,0)}static addFaults(t,e){t.addFieldInt32(13,e,0)}static addRecording(t,e){t.addFieldOffset(14,e,0)}static addRows(t,e){t.addFieldOffset(15,e,0)}static startRowsVector(t,e){t.startVector(56,e,8)}static endScore(t){return t.endObject()}static createScore(t,e,n,s,r,o,a,l,c,h,f,u,p,_,b,m,d){return Xe.startScore(t),Xe.addAttempt(t,e),Xe.addScene(t,n),Xe.addTrainee(t,s),Xe.addBegan(t,r),Xe.addDurationS(t,o),Xe.addPathM(t,a),Xe.addDepthPathM(t,l),Xe.addPunctures(t,c),Xe.addWithdrawals(t,h),Xe.addTargets(t,f),Xe.addPeakForceN(t,u),Xe.addPeakLateralN(t,p),Xe.addMeanForceN(t,_),Xe.addFaults(t,b),Xe.addRecording(t,m),Xe.addRows(t,d),Xe.endScore(t)}}class ir{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsSeek(t,e){return(e||new ir).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsSeek(t,e){return t.setPosition(t.position()+4),(e||new ir).__init(t.readInt32(t.position())+t.position(),t)}tick(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}static startSeek(t){t.startObject(1)}static addTick(t,e){t.addFieldInt64(0,e,BigInt("0"))}static endSeek(t){return t.endObject()}static createSeek(t,e){return ir.startSeek(t),ir.addTick(t,e),ir.endSeek(t)}}class sr{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsStart(t,e){return(e||new sr).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsStart(t,e){return t.setPosition(t.position()+4),(e||new sr).__init(t.readInt32(t.position())+t.position(),t)}trainee(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}static startStart(t){t.startObject(1)}static addTrainee(t,e){t.addFieldOffset(0,e,0)}static endStart(t){return t.endObject()}static createStart(t,e){return sr.startStart(t),sr.addTrainee(t,e),sr.endStart(t)}}var je=(i=>(i[i.NONE=0]="NONE",i[i.Hello=1]="Hello",i[i.Frame=2]="Frame",i[i.Rows=3]="Rows",i[i.Score=4]="Score",i[i.Marked=5]="Marked",i[i.Refused=6]="Refused",i[i.Start=7]="Start",i[i.Pause=8]="Pause",i[i.Resume=9]="Resume",i[i.Reset=10]="Reset",i[i.Choose=11]="Choose",i[i.Seek=12]="Seek",i[i.Play=13]="Play",i[i.AskRows=14]="AskRows",i[i.Mark=15]="Mark",i[i.Pointer=16]="Pointer",i[i.Acknowledge=17]="Acknowledge",i[i.End=18]="End",i))(je||{});class ls{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsMessage(t,e){return(e||new ls).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsMessage(t,e){return t.setPosition(t.position()+4),(e||new ls).__init(t.readInt32(t.position())+t.position(),t)}static bufferHasIdentifier(t){return t.__has_identifier("STLC")}bodyType(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint8(this.bb_pos+t):je.NONE}body(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__union(t,this.bb_pos+e):null}static startMessage(t){t.startObject(2)}static addBodyType(t,e){t.addFieldInt8(0,e,je.NONE)}static addBody(t,e){t.addFieldOffset(1,e,0)}static endMessage(t){return t.endObject()}static finishMessageBuffer(t,e){t.finish(e,"STLC")}static finishSizePrefixedMessageBuffer(t,e){t.finish(e,"STLC",!0)}static createMessage(t,e,n){return ls.startMessage(t),ls.addBodyType(t,e),ls.addBody(t,n),ls.endMessage(t)}}const Jp=2,Qp="STLC";var On=(i=>(i[i.Ready=0]="Ready",i[i.Running=1]="Running",i[i.Paused=2]="Paused",i[i.Ended=3]="Ended",i[i.Playback=4]="Playback",i))(On||{});const _g=4294967295,fh=["stiffness","cutting","friction","clamping","obstacle"],gg={x:0,y:0,z:0},bg={w:1,x:0,y:0,z:0},Je=i=>i?{x:i.x(),y:i.y(),z:i.z()}:gg,tm=i=>i?{w:i.w(),x:i.x(),y:i.y(),z:i.z()}:bg,kn=i=>typeof i=="string"?i:"";let dh=0;function em(i){if(dh-=i,i<0||dh<0)throw new RangeError("more elements than bytes")}function Pn(i,t,e){em(i);const n=[];for(let s=0;s<i;++s){const r=t(s);r!==null&&n.push(e(r))}return n}function vg(i){return{device:kn(i.device()),length:i.lengthM(),outerRadius:i.outerRadiusM(),entry:Je(i.entryM()),direction:Je(i.direction()),maxForce:i.maxForceN()}}function xg(i){return{position:Je(i.positionM()),rotation:tm(i.rotation()),vertices:Pn(i.verticesMLength(),t=>i.verticesM(t),Je),rounding:i.roundingM()}}function Mg(i){em(i.restMLength());const t=new Float32Array(3*i.restMLength()),e=new we;for(let n=0;3*n<t.length;++n)i.restM(n,e),t[3*n]=e.x(),t[3*n+1]=e.y(),t[3*n+2]=e.z();return t}function yg(i){return{kind:"hello",protocol:i.protocol(),version:kn(i.styletVersion()),scene:kn(i.scene()),scenes:Pn(i.scenesLength(),t=>i.scenes(t),kn),period:i.periodS(),recordingTicks:Number(i.recordingTicks()),voxelEdge:i.voxelEdgeM(),particles:i.particles(),rest:Mg(i),corners:(i.cornersArray()??new Uint32Array).slice(),positionUnit:i.positionUnitM(),needles:Pn(i.needlesLength(),t=>i.needles(t),vg),obstacles:Pn(i.obstaclesLength(),t=>i.obstacles(t),xg),targets:Pn(i.targetsLength(),t=>i.targets(t),t=>({name:kn(t.name()),position:Je(t.positionM()),radius:t.radiusM(),forbidden:t.forbidden()})),mayControl:i.mayControl()}}function Sg(i){return{nodes:Pn(i.nodesMLength(),t=>i.nodesM(t),Je),handle:Je(i.handlePositionM()),handleRotation:tm(i.handleRotation()),tip:Je(i.tipM()),depth:i.depthM(),phase:i.phase(),layer:i.layer(),force:Je(i.forceN()),command:Je(i.commandN()),causes:{stiffness:Je(i.stiffnessN()),cutting:Je(i.cuttingN()),friction:Je(i.frictionN()),clamping:Je(i.clampingN()),obstacle:Je(i.obstacleN())},fault:kn(i.fault()),faultNumber:i.faultNumber(),guard:kn(i.guard()),flags:i.flags()}}function bu(i){return{tick:Number(i.tick()),depth:i.depthM(),travel:i.travelM(),force:i.forceN(),lateral:i.lateralN(),stiffness:i.stiffnessN(),cutting:i.cuttingN(),friction:i.frictionN(),clamping:i.clampingN(),obstacle:i.obstacleN(),tickUs:i.tickUs(),lateUs:i.lateUs(),needle:i.needle()}}const nm=i=>({tick:Number(i.tick()),eventKind:i.kind(),needle:i.needle(),layer:i.layer(),depth:i.depthM(),force:i.forceN()});function wg(i){return i===null?null:{ticks:Number(i.ticks()),missed:Number(i.missed()),lostRecords:Number(i.lostRecords()),lostFrames:Number(i.lostFrames()),connections:i.connections(),tickUs:i.tickUsArray()??new Float32Array,lateUs:i.lateUsArray()??new Float32Array,tickBins:i.tickBinsArray()??new Uint32Array,lateBins:i.lateBinsArray()??new Uint32Array,binUs:i.binUs()}}function Eg(i){return{kind:"frame",tick:Number(i.tick()),activity:i.activity(),key:i.key(),movedIndex:i.movedIndexArray()??new Uint32Array,movedTo:i.movedToArray()??new Int16Array,needles:Pn(i.needlesLength(),t=>i.needles(t),Sg),particles:Pn(i.particlesLength(),t=>i.particles(t),t=>({position:Je(t.positionM(new we)),goal:Je(t.goalM(new we)),force:Je(t.forceN(new we)),needle:t.needle()})),touches:Pn(i.touchesLength(),t=>i.touches(t),t=>({position:Je(t.positionM(new we)),force:Je(t.forceN(new we)),needle:t.needle()})),events:Pn(i.eventsLength(),t=>i.events(t),nm),rows:Pn(i.rowsLength(),t=>i.rows(t),bu),timing:wg(i.timing()),attempt:i.attempt(),timeNs:i.timeNs()}}function Tg(i){return{kind:"score",attempt:i.attempt(),scene:kn(i.scene()),trainee:kn(i.trainee()),began:kn(i.began()),duration:i.durationS(),path:i.pathM(),depthPath:i.depthPathM(),punctures:Pn(i.puncturesLength(),t=>i.punctures(t),t=>({tick:Number(t.tick()),layer:kn(t.layer()),force:t.forceN()})),withdrawals:i.withdrawals(),targets:Pn(i.targetsLength(),t=>i.targets(t),t=>({name:kn(t.name()),forbidden:t.forbidden(),closest:t.closestM(),reached:t.reached()})),peakForce:i.peakForceN(),peakLateral:i.peakLateralN(),meanForce:i.meanForceN(),faults:i.faults(),recording:kn(i.recording()),rows:Pn(i.rowsLength(),t=>i.rows(t),bu)}}const Ag=i=>({kind:"rows",first:Number(i.first()),stride:i.stride(),rows:Pn(i.rowsLength(),t=>i.rows(t),bu),events:Pn(i.eventsLength(),t=>i.events(t),nm)});function Rg(i){try{const t=new co(new Uint8Array(i));if(dh=i.byteLength/4,i.byteLength<12||!t.__has_identifier(Qp))return null;const e=ls.getRootAsMessage(t),n=s=>e.body(s);switch(e.bodyType()){case je.Hello:return yg(n(new qe));case je.Frame:return Eg(n(new ul));case je.Rows:return Ag(n(new Oi));case je.Score:return Tg(n(new Xe));case je.Marked:{const s=n(new ts);return{kind:"marked",tick:Number(s.tick()),text:kn(s.text()),attempt:s.attempt()}}case je.Refused:return{kind:"refused",what:kn(n(new nr).what())};default:return null}}catch{return null}}function si(i,t){const e=new _u(128),n=t(e),s=ls.createMessage(e,i,n);return e.finish(s,Qp),e.asUint8Array()}const Jn={start:i=>si(je.Start,t=>sr.createStart(t,t.createString(i))),pause:()=>si(je.Pause,i=>Kr.createPause(i)),resume:()=>si(je.Resume,i=>Qr.createResume(i)),reset:()=>si(je.Reset,i=>Jr.createReset(i)),end:()=>si(je.End,i=>Zr.createEnd(i)),choose:i=>si(je.Choose,t=>Qs.createChoose(t,t.createString(i))),seek:i=>si(je.Seek,t=>ir.createSeek(t,BigInt(Math.max(0,Math.round(i))))),play:i=>si(je.Play,t=>er.createPlay(t,i)),rows:(i,t,e)=>si(je.AskRows,n=>Qi.createAskRows(n,BigInt(i),BigInt(t),e)),mark:i=>si(je.Mark,t=>tr.createMark(t,t.createString(i))),pointer:(i,t,e,n)=>si(je.Pointer,s=>(as.startPointer(s),as.addNeedle(s,i),as.addPositionM(s,we.createVec3(s,t.x,t.y,t.z)),as.addRotation(s,Dl.createQuaternion(s,e.w,e.x,e.y,e.z)),as.addButtons(s,n),as.endPointer(s))),acknowledge:(i,t)=>si(je.Acknowledge,e=>{const{fault:n,faultNumber:s}=i.needles[t];return Ni.createAcknowledge(e,t,e.createString(n),s,i.timeNs)})},Pg=500,Cg=1e4,Lg=65536;function im(i,t){const e=new URL(i,t.href),n=new URLSearchParams(t.search).get("token");return e.search=n===null?"":`?${new URLSearchParams({token:n}).toString()}`,e}function Ig(i,t){return Math.min(Cg,Pg*2**Math.max(0,i-1))*(.5+.5*t)}class Fg{constructor(t,e,n,s){this.heard=t,this.changed=e,this.garbled=n,this.timed=s,this.link={state:"connecting",retryAt:0,theirs:0},this.socket=null,this.failures=0,this.timer=0}open(){window.clearTimeout(this.timer),this.socket?.close();const t=im("ws",window.location);t.protocol=t.protocol==="https:"?"wss:":"ws:";const e=new WebSocket(t);e.binaryType="arraybuffer",this.socket=e,this.enter("connecting"),e.onopen=()=>this.enter("open"),e.onmessage=n=>{e===this.socket&&this.timed(()=>this.take(n.data))},e.onclose=()=>e===this.socket&&this.lost()}send(t){const e=this.socket;return e===null||e.readyState!==WebSocket.OPEN||e.bufferedAmount>Lg?!1:(e.send(t),!0)}take(t){const e=t instanceof ArrayBuffer?Rg(t):null;if(e===null){this.garbled();return}if(e.kind==="hello"){if(e.protocol!==Jp){this.link.theirs=e.protocol;const n=this.socket;this.socket=null,n?.close(),this.enter("closed");return}this.failures=0}this.heard(e)}lost(){this.socket=null,++this.failures;const t=Ig(this.failures,Math.random());this.link.retryAt=performance.now()+t,this.timer=window.setTimeout(()=>this.open(),t),this.enter("waiting")}enter(t){this.link.state=t,this.changed()}}function tt(i,t={},...e){const n=document.createElement(i);for(const[s,r]of Object.entries(t))typeof r=="function"?n.addEventListener(s.slice(2),r):r===!0?n.setAttribute(s,""):r!==!1&&n.setAttribute(s,String(r));return n.append(...e),n}function xn(i,t){i.textContent!==t&&(i.textContent=t)}function $e(i,t,e={}){return tt("button",{type:"button",onclick:t,...e},i)}function ph(i,t){const e=$e(i,()=>ml(e,e.getAttribute("aria-pressed")!=="true",t),{"aria-pressed":"false",class:"toggle"});return e}function ml(i,t,e){i.setAttribute("aria-pressed",String(t)),e?.(t)}let Dg=0;function ta(i,t){return t.id||=`field-${++Dg}`,tt("div",{class:"field"},tt("label",{for:t.id},i),t)}function Ns(i,t,e,...n){const s=`${i}-heading`;return tt("section",{class:`panel ${i}`,"data-in":e,"aria-labelledby":s},tt("h2",{id:s},t),...n)}function _l(i,t,e=""){const n=tt("table");return e!==""&&n.append(tt("caption",{},e)),n.append(tt("thead",{},tt("tr",{},...i.map(s=>tt("th",{scope:"col"},s))))),n.append(tt("tbody",{},...t.map(([s,...r])=>tt("tr",{},tt("th",{scope:"row"},s),...r.map(o=>tt("td",{},o)))))),n}function hc(i,t,e){const n=URL.createObjectURL(new Blob([e],{type:t}));tt("a",{href:n,download:i}).click(),window.setTimeout(()=>URL.revokeObjectURL(n),1e3)}const dr=()=>matchMedia("(prefers-color-scheme: dark)").matches,Ug=()=>matchMedia("(prefers-reduced-motion: reduce)").matches;function sm(i,t){let e=!1,n=-1/0;return()=>{if(e)return;e=!0;const s=Math.max(0,i-(performance.now()-n));window.setTimeout(()=>{e=!1,n=performance.now(),t()},s)}}class Ng{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}x(){return this.bb.readUint16(this.bb_pos)}y(){return this.bb.readUint16(this.bb_pos+2)}z(){return this.bb.readUint16(this.bb_pos+4)}voxelX(){return this.bb.readUint16(this.bb_pos+6)}voxelY(){return this.bb.readUint16(this.bb_pos+8)}voxelZ(){return this.bb.readUint16(this.bb_pos+10)}static sizeOf(){return 12}static createHanging(t,e,n,s,r,o,a){return t.prep(2,12),t.writeInt16(a),t.writeInt16(o),t.writeInt16(r),t.writeInt16(s),t.writeInt16(n),t.writeInt16(e),t.offset()}}class ns{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsLevels(t,e){return(e||new ns).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsLevels(t,e){return t.setPosition(t.position()+4),(e||new ns).__init(t.readInt32(t.position())+t.position(),t)}count(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint8(this.bb_pos+t):0}planes(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.readUint16(this.bb_pos+t):0}hanging(t,e){const n=this.bb.__offset(this.bb_pos,8);return n?(e||new Ng).__init(this.bb.__vector(this.bb_pos+n)+t*12,this.bb):null}hangingLength(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.__vector_len(this.bb_pos+t):0}static startLevels(t){t.startObject(3)}static addCount(t,e){t.addFieldInt8(0,e,0)}static addPlanes(t,e){t.addFieldInt16(1,e,0)}static addHanging(t,e){t.addFieldOffset(2,e,0)}static startHangingVector(t,e){t.startVector(12,e,2)}static endLevels(t){return t.endObject()}static createLevels(t,e,n,s){return ns.startLevels(t),ns.addCount(t,e),ns.addPlanes(t,n),ns.addHanging(t,s),ns.endLevels(t)}}let Og=class Te{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsMaterial(t,e){return(e||new Te).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsMaterial(t,e){return t.setPosition(t.position()+4),(e||new Te).__init(t.readInt32(t.position())+t.position(),t)}name(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}source(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}densityKgPerM3(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readFloat32(this.bb_pos+t):0}youngsModulusPa(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.readFloat32(this.bb_pos+t):0}poissonRatio(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readFloat32(this.bb_pos+t):0}relaxingFraction(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readFloat32(this.bb_pos+t):0}relaxationTimeS(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.readFloat32(this.bb_pos+t):0}punctureForceN(){const t=this.bb.__offset(this.bb_pos,18);return t?this.bb.readFloat32(this.bb_pos+t):0}cuttingForceN(){const t=this.bb.__offset(this.bb_pos,20);return t?this.bb.readFloat32(this.bb_pos+t):0}recutFraction(){const t=this.bb.__offset(this.bb_pos,22);return t?this.bb.readFloat32(this.bb_pos+t):0}coulombFrictionNPerM(){const t=this.bb.__offset(this.bb_pos,24);return t?this.bb.readFloat32(this.bb_pos+t):0}staticFrictionNPerM(){const t=this.bb.__offset(this.bb_pos,26);return t?this.bb.readFloat32(this.bb_pos+t):0}stribeckVelocityMPerS(){const t=this.bb.__offset(this.bb_pos,28);return t?this.bb.readFloat32(this.bb_pos+t):0}viscousFrictionNSPerM2(){const t=this.bb.__offset(this.bb_pos,30);return t?this.bb.readFloat32(this.bb_pos+t):0}punctureVelocityExponent(){const t=this.bb.__offset(this.bb_pos,32);return t?this.bb.readFloat32(this.bb_pos+t):0}membraneNPerM(){const t=this.bb.__offset(this.bb_pos,34);return t?this.bb.readFloat32(this.bb_pos+t):0}strainStiffening(){const t=this.bb.__offset(this.bb_pos,36);return t?this.bb.readFloat32(this.bb_pos+t):0}fractureToughnessJPerM2(){const t=this.bb.__offset(this.bb_pos,38);return t?this.bb.readFloat32(this.bb_pos+t):0}toughnessVelocityExponent(){const t=this.bb.__offset(this.bb_pos,40);return t?this.bb.readFloat32(this.bb_pos+t):0}needleFrictionCoefficient(){const t=this.bb.__offset(this.bb_pos,42);return t?this.bb.readFloat32(this.bb_pos+t):0}fluidPressurePa(){const t=this.bb.__offset(this.bb_pos,44);return t?this.bb.readFloat32(this.bb_pos+t):0}fluidConductanceM3PerPaS(){const t=this.bb.__offset(this.bb_pos,46);return t?this.bb.readFloat32(this.bb_pos+t):0}fluidViscosityPaS(){const t=this.bb.__offset(this.bb_pos,48);return t?this.bb.readFloat32(this.bb_pos+t):0}static startMaterial(t){t.startObject(23)}static addName(t,e){t.addFieldOffset(0,e,0)}static addSource(t,e){t.addFieldOffset(1,e,0)}static addDensityKgPerM3(t,e){t.addFieldFloat32(2,e,0)}static addYoungsModulusPa(t,e){t.addFieldFloat32(3,e,0)}static addPoissonRatio(t,e){t.addFieldFloat32(4,e,0)}static addRelaxingFraction(t,e){t.addFieldFloat32(5,e,0)}static addRelaxationTimeS(t,e){t.addFieldFloat32(6,e,0)}static addPunctureForceN(t,e){t.addFieldFloat32(7,e,0)}static addCuttingForceN(t,e){t.addFieldFloat32(8,e,0)}static addRecutFraction(t,e){t.addFieldFloat32(9,e,0)}static addCoulombFrictionNPerM(t,e){t.addFieldFloat32(10,e,0)}static addStaticFrictionNPerM(t,e){t.addFieldFloat32(11,e,0)}static addStribeckVelocityMPerS(t,e){t.addFieldFloat32(12,e,0)}static addViscousFrictionNSPerM2(t,e){t.addFieldFloat32(13,e,0)}static addPunctureVelocityExponent(t,e){t.addFieldFloat32(14,e,0)}static addMembraneNPerM(t,e){t.addFieldFloat32(15,e,0)}static addStrainStiffening(t,e){t.addFieldFloat32(16,e,0)}static addFractureToughnessJPerM2(t,e){t.addFieldFloat32(17,e,0)}static addToughnessVelocityExponent(t,e){t.addFieldFloat32(18,e,0)}static addNeedleFrictionCoefficient(t,e){t.addFieldFloat32(19,e,0)}static addFluidPressurePa(t,e){t.addFieldFloat32(20,e,0)}static addFluidConductanceM3PerPaS(t,e){t.addFieldFloat32(21,e,0)}static addFluidViscosityPaS(t,e){t.addFieldFloat32(22,e,0)}static endMaterial(t){const e=t.endObject();return t.requiredField(e,4),e}static createMaterial(t,e,n,s,r,o,a,l,c,h,f,u,p,_,b,m,d,M,w,v,U,P,L,F){return Te.startMaterial(t),Te.addName(t,e),Te.addSource(t,n),Te.addDensityKgPerM3(t,s),Te.addYoungsModulusPa(t,r),Te.addPoissonRatio(t,o),Te.addRelaxingFraction(t,a),Te.addRelaxationTimeS(t,l),Te.addPunctureForceN(t,c),Te.addCuttingForceN(t,h),Te.addRecutFraction(t,f),Te.addCoulombFrictionNPerM(t,u),Te.addStaticFrictionNPerM(t,p),Te.addStribeckVelocityMPerS(t,_),Te.addViscousFrictionNSPerM2(t,b),Te.addPunctureVelocityExponent(t,m),Te.addMembraneNPerM(t,d),Te.addStrainStiffening(t,M),Te.addFractureToughnessJPerM2(t,w),Te.addToughnessVelocityExponent(t,v),Te.addNeedleFrictionCoefficient(t,U),Te.addFluidPressurePa(t,P),Te.addFluidConductanceM3PerPaS(t,L),Te.addFluidViscosityPaS(t,F),Te.endMaterial(t)}};class kg{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}x(){return this.bb.readUint16(this.bb_pos)}y(){return this.bb.readUint16(this.bb_pos+2)}z(){return this.bb.readUint16(this.bb_pos+4)}material(){return this.bb.readUint16(this.bb_pos+6)}first(){return this.bb.readUint32(this.bb_pos+8)}count(){return this.bb.readUint32(this.bb_pos+12)}area(){return this.bb.readFloat32(this.bb_pos+16)}static sizeOf(){return 20}static createMembraneCell(t,e,n,s,r,o,a,l){return t.prep(4,20),t.writeFloat32(l),t.writeInt32(a),t.writeInt32(o),t.writeInt16(r),t.writeInt16(s),t.writeInt16(n),t.writeInt16(e),t.offset()}}class Bg{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}x(){return this.bb.readFloat32(this.bb_pos)}y(){return this.bb.readFloat32(this.bb_pos+4)}z(){return this.bb.readFloat32(this.bb_pos+8)}static sizeOf(){return 12}static createMembranePoint(t,e,n,s){return t.prep(4,12),t.writeFloat32(s),t.writeFloat32(n),t.writeFloat32(e),t.offset()}}let vu=class{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}a(){return this.bb.readUint32(this.bb_pos)}b(){return this.bb.readUint32(this.bb_pos+4)}c(){return this.bb.readUint32(this.bb_pos+8)}static sizeOf(){return 12}static createTriangle(t,e,n,s){return t.prep(4,12),t.writeInt32(s),t.writeInt32(n),t.writeInt32(e),t.offset()}};class is{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsMembranes(t,e){return(e||new is).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsMembranes(t,e){return t.setPosition(t.position()+4),(e||new is).__init(t.readInt32(t.position())+t.position(),t)}points(t,e){const n=this.bb.__offset(this.bb_pos,4);return n?(e||new Bg).__init(this.bb.__vector(this.bb_pos+n)+t*12,this.bb):null}pointsLength(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.__vector_len(this.bb_pos+t):0}triangles(t,e){const n=this.bb.__offset(this.bb_pos,6);return n?(e||new vu).__init(this.bb.__vector(this.bb_pos+n)+t*12,this.bb):null}trianglesLength(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.__vector_len(this.bb_pos+t):0}cells(t,e){const n=this.bb.__offset(this.bb_pos,8);return n?(e||new kg).__init(this.bb.__vector(this.bb_pos+n)+t*20,this.bb):null}cellsLength(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.__vector_len(this.bb_pos+t):0}static startMembranes(t){t.startObject(3)}static addPoints(t,e){t.addFieldOffset(0,e,0)}static startPointsVector(t,e){t.startVector(12,e,4)}static addTriangles(t,e){t.addFieldOffset(1,e,0)}static startTrianglesVector(t,e){t.startVector(12,e,4)}static addCells(t,e){t.addFieldOffset(2,e,0)}static startCellsVector(t,e){t.startVector(20,e,4)}static endMembranes(t){return t.endObject()}static createMembranes(t,e,n,s){return is.startMembranes(t),is.addPoints(t,e),is.addTriangles(t,n),is.addCells(t,s),is.endMembranes(t)}}class zg{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}voxel(){return this.bb.readUint32(this.bb_pos)}material(){return this.bb.readUint16(this.bb_pos+4)}reserved(){return this.bb.readUint16(this.bb_pos+6)}nx(){return this.bb.readFloat32(this.bb_pos+8)}ny(){return this.bb.readFloat32(this.bb_pos+12)}nz(){return this.bb.readFloat32(this.bb_pos+16)}limit(){return this.bb.readFloat32(this.bb_pos+20)}static sizeOf(){return 24}static createMixed(t,e,n,s,r,o,a,l){return t.prep(4,24),t.writeFloat32(l),t.writeFloat32(a),t.writeFloat32(o),t.writeFloat32(r),t.writeInt16(s),t.writeInt16(n),t.writeInt32(e),t.offset()}}let Vg=class vi{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsSource(t,e){return(e||new vi).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsSource(t,e){return t.setPosition(t.position()+4),(e||new vi).__init(t.readInt32(t.position())+t.position(),t)}path(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}tissue(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}sha256(t){const e=this.bb.__offset(this.bb_pos,8);return e?this.bb.__string(this.bb_pos+e,t):null}metresPerUnit(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.readFloat64(this.bb_pos+t):0}priority(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readInt32(this.bb_pos+t):0}triangleCount(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readUint32(this.bb_pos+t):0}static startSource(t){t.startObject(6)}static addPath(t,e){t.addFieldOffset(0,e,0)}static addTissue(t,e){t.addFieldOffset(1,e,0)}static addSha256(t,e){t.addFieldOffset(2,e,0)}static addMetresPerUnit(t,e){t.addFieldFloat64(3,e,0)}static addPriority(t,e){t.addFieldInt32(4,e,0)}static addTriangleCount(t,e){t.addFieldInt32(5,e,0)}static endSource(t){return t.endObject()}static createSource(t,e,n,s,r,o,a){return vi.startSource(t),vi.addPath(t,e),vi.addTissue(t,n),vi.addSha256(t,s),vi.addMetresPerUnit(t,r),vi.addPriority(t,o),vi.addTriangleCount(t,a),vi.endSource(t)}};class ss{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsProvenance(t,e){return(e||new ss).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsProvenance(t,e){return t.setPosition(t.position()+4),(e||new ss).__init(t.readInt32(t.position())+t.position(),t)}toolVersion(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}options(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}sources(t,e){const n=this.bb.__offset(this.bb_pos,8);return n?(e||new Vg).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}sourcesLength(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.__vector_len(this.bb_pos+t):0}static startProvenance(t){t.startObject(3)}static addToolVersion(t,e){t.addFieldOffset(0,e,0)}static addOptions(t,e){t.addFieldOffset(1,e,0)}static addSources(t,e){t.addFieldOffset(2,e,0)}static createSourcesVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startSourcesVector(t,e){t.startVector(4,e,4)}static endProvenance(t){return t.endObject()}static createProvenance(t,e,n,s){return ss.startProvenance(t),ss.addToolVersion(t,e),ss.addOptions(t,n),ss.addSources(t,s),ss.endProvenance(t)}}class rm{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}x(){return this.bb.readUint16(this.bb_pos)}y(){return this.bb.readUint16(this.bb_pos+2)}z(){return this.bb.readUint16(this.bb_pos+4)}count(){return this.bb.readUint16(this.bb_pos+6)}static sizeOf(){return 8}static createRun(t,e,n,s,r){return t.prep(2,8),t.writeInt16(r),t.writeInt16(s),t.writeInt16(n),t.writeInt16(e),t.offset()}}class Hg{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}x(){return this.bb.readUint16(this.bb_pos)}y(){return this.bb.readUint16(this.bb_pos+2)}z(){return this.bb.readUint16(this.bb_pos+4)}reserved(){return this.bb.readUint16(this.bb_pos+6)}quarters(){return this.bb.readUint64(this.bb_pos+8)}static sizeOf(){return 16}static createPart(t,e,n,s,r,o){return t.prep(8,16),t.writeInt64(o),t.writeInt16(r),t.writeInt16(s),t.writeInt16(n),t.writeInt16(e),t.offset()}}class Gg{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}x(){return this.bb.readUint16(this.bb_pos)}y(){return this.bb.readUint16(this.bb_pos+2)}z(){return this.bb.readUint16(this.bb_pos+4)}toY(){return this.bb.readUint16(this.bb_pos+6)}static sizeOf(){return 8}static createTie(t,e,n,s,r){return t.prep(2,8),t.writeInt16(r),t.writeInt16(s),t.writeInt16(n),t.writeInt16(e),t.offset()}}class rs{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsSheets(t,e){return(e||new rs).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsSheets(t,e){return t.setPosition(t.position()+4),(e||new rs).__init(t.readInt32(t.position())+t.position(),t)}rows(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint16(this.bb_pos+t):0}ties(t,e){const n=this.bb.__offset(this.bb_pos,6);return n?(e||new Gg).__init(this.bb.__vector(this.bb_pos+n)+t*8,this.bb):null}tiesLength(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.__vector_len(this.bb_pos+t):0}parts(t,e){const n=this.bb.__offset(this.bb_pos,8);return n?(e||new Hg).__init(this.bb.__vector(this.bb_pos+n)+t*16,this.bb):null}partsLength(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.__vector_len(this.bb_pos+t):0}static startSheets(t){t.startObject(3)}static addRows(t,e){t.addFieldInt16(0,e,0)}static addTies(t,e){t.addFieldOffset(1,e,0)}static startTiesVector(t,e){t.startVector(8,e,2)}static addParts(t,e){t.addFieldOffset(2,e,0)}static startPartsVector(t,e){t.startVector(16,e,8)}static endSheets(t){return t.endObject()}static createSheets(t,e,n,s){return rs.startSheets(t),rs.addRows(t,e),rs.addTies(t,n),rs.addParts(t,s),rs.endSheets(t)}}class Wg{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}voxel(){return this.bb.readUint32(this.bb_pos)}area(){return this.bb.readFloat32(this.bb_pos+4)}static sizeOf(){return 8}static createSkin(t,e,n){return t.prep(4,8),t.writeFloat32(n),t.writeInt32(e),t.offset()}}class Xg{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}voxel(){return this.bb.readUint32(this.bb_pos)}distance0(){return this.bb.readFloat32(this.bb_pos+4)}distance1(){return this.bb.readFloat32(this.bb_pos+8)}distance2(){return this.bb.readFloat32(this.bb_pos+12)}distance3(){return this.bb.readFloat32(this.bb_pos+16)}distance4(){return this.bb.readFloat32(this.bb_pos+20)}distance5(){return this.bb.readFloat32(this.bb_pos+24)}distance6(){return this.bb.readFloat32(this.bb_pos+28)}distance7(){return this.bb.readFloat32(this.bb_pos+32)}static sizeOf(){return 36}static createSlideGround(t,e,n,s,r,o,a,l,c,h){return t.prep(4,36),t.writeFloat32(h),t.writeFloat32(c),t.writeFloat32(l),t.writeFloat32(a),t.writeFloat32(o),t.writeFloat32(r),t.writeFloat32(s),t.writeFloat32(n),t.writeInt32(e),t.offset()}}class Yg{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}voxel(){return this.bb.readUint32(this.bb_pos)}fx(){return this.bb.readUint16(this.bb_pos+4)}fy(){return this.bb.readUint16(this.bb_pos+6)}fz(){return this.bb.readUint16(this.bb_pos+8)}reserved(){return this.bb.readUint16(this.bb_pos+10)}area(){return this.bb.readFloat32(this.bb_pos+12)}ground(){return this.bb.readUint32(this.bb_pos+16)}friction(){return this.bb.readFloat32(this.bb_pos+20)}static sizeOf(){return 24}static createSlidePoint(t,e,n,s,r,o,a,l,c){return t.prep(4,24),t.writeFloat32(c),t.writeInt32(l),t.writeFloat32(a),t.writeInt16(o),t.writeInt16(r),t.writeInt16(s),t.writeInt16(n),t.writeInt32(e),t.offset()}}class os{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsSlides(t,e){return(e||new os).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsSlides(t,e){return t.setPosition(t.position()+4),(e||new os).__init(t.readInt32(t.position())+t.position(),t)}points(t,e){const n=this.bb.__offset(this.bb_pos,4);return n?(e||new Yg).__init(this.bb.__vector(this.bb_pos+n)+t*24,this.bb):null}pointsLength(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.__vector_len(this.bb_pos+t):0}grounds(t,e){const n=this.bb.__offset(this.bb_pos,6);return n?(e||new Xg).__init(this.bb.__vector(this.bb_pos+n)+t*36,this.bb):null}groundsLength(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.__vector_len(this.bb_pos+t):0}bodies(t){const e=this.bb.__offset(this.bb_pos,8);return e?this.bb.readUint8(this.bb.__vector(this.bb_pos+e)+t):0}bodiesLength(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.__vector_len(this.bb_pos+t):0}bodiesArray(){const t=this.bb.__offset(this.bb_pos,8);return t?new Uint8Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}static startSlides(t){t.startObject(3)}static addPoints(t,e){t.addFieldOffset(0,e,0)}static startPointsVector(t,e){t.startVector(24,e,4)}static addGrounds(t,e){t.addFieldOffset(1,e,0)}static startGroundsVector(t,e){t.startVector(36,e,4)}static addBodies(t,e){t.addFieldOffset(2,e,0)}static createBodiesVector(t,e){t.startVector(1,e.length,1);for(let n=e.length-1;n>=0;n--)t.addInt8(e[n]);return t.endVector()}static startBodiesVector(t,e){t.startVector(1,e,1)}static endSlides(t){return t.endObject()}static createSlides(t,e,n,s){return os.startSlides(t),os.addPoints(t,e),os.addGrounds(t,n),os.addBodies(t,s),os.endSlides(t)}}class qg{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}x(){return this.bb.readFloat32(this.bb_pos)}y(){return this.bb.readFloat32(this.bb_pos+4)}z(){return this.bb.readFloat32(this.bb_pos+8)}radius(){return this.bb.readFloat32(this.bb_pos+12)}first(){return this.bb.readUint32(this.bb_pos+16)}count(){return this.bb.readUint32(this.bb_pos+20)}static sizeOf(){return 24}static createSphereNode(t,e,n,s,r,o,a){return t.prep(4,24),t.writeInt32(a),t.writeInt32(o),t.writeFloat32(r),t.writeFloat32(s),t.writeFloat32(n),t.writeFloat32(e),t.offset()}}class om{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}voxel(){return this.bb.readUint32(this.bb_pos)}fx(){return this.bb.readUint16(this.bb_pos+4)}fy(){return this.bb.readUint16(this.bb_pos+6)}fz(){return this.bb.readUint16(this.bb_pos+8)}reserved(){return this.bb.readUint16(this.bb_pos+10)}static sizeOf(){return 12}static createVertex(t,e,n,s,r,o){return t.prep(4,12),t.writeInt16(o),t.writeInt16(r),t.writeInt16(s),t.writeInt16(n),t.writeInt32(e),t.offset()}}class gl{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsOrgan(t,e){return(e||new gl).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsOrgan(t,e){return t.setPosition(t.position()+4),(e||new gl).__init(t.readInt32(t.position())+t.position(),t)}static bufferHasIdentifier(t){return t.__has_identifier("STLO")}formatVersion(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint32(this.bb_pos+t):0}name(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}voxelEdgeM(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readFloat32(this.bb_pos+t):0}originXM(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.readFloat32(this.bb_pos+t):0}originYM(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readFloat32(this.bb_pos+t):0}originZM(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readFloat32(this.bb_pos+t):0}sizeX(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.readUint16(this.bb_pos+t):0}sizeY(){const t=this.bb.__offset(this.bb_pos,18);return t?this.bb.readUint16(this.bb_pos+t):0}sizeZ(){const t=this.bb.__offset(this.bb_pos,20);return t?this.bb.readUint16(this.bb_pos+t):0}runs(t,e){const n=this.bb.__offset(this.bb_pos,22);return n?(e||new rm).__init(this.bb.__vector(this.bb_pos+n)+t*8,this.bb):null}runsLength(){const t=this.bb.__offset(this.bb_pos,22);return t?this.bb.__vector_len(this.bb_pos+t):0}voxelMaterial(t){const e=this.bb.__offset(this.bb_pos,24);return e?this.bb.readUint8(this.bb.__vector(this.bb_pos+e)+t):0}voxelMaterialLength(){const t=this.bb.__offset(this.bb_pos,24);return t?this.bb.__vector_len(this.bb_pos+t):0}voxelMaterialArray(){const t=this.bb.__offset(this.bb_pos,24);return t?new Uint8Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}voxelFill(t){const e=this.bb.__offset(this.bb_pos,26);return e?this.bb.readUint8(this.bb.__vector(this.bb_pos+e)+t):0}voxelFillLength(){const t=this.bb.__offset(this.bb_pos,26);return t?this.bb.__vector_len(this.bb_pos+t):0}voxelFillArray(){const t=this.bb.__offset(this.bb_pos,26);return t?new Uint8Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}voxelFixed(t){const e=this.bb.__offset(this.bb_pos,28);return e?this.bb.readUint8(this.bb.__vector(this.bb_pos+e)+t):0}voxelFixedLength(){const t=this.bb.__offset(this.bb_pos,28);return t?this.bb.__vector_len(this.bb_pos+t):0}voxelFixedArray(){const t=this.bb.__offset(this.bb_pos,28);return t?new Uint8Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}materials(t,e){const n=this.bb.__offset(this.bb_pos,30);return n?(e||new Og).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}materialsLength(){const t=this.bb.__offset(this.bb_pos,30);return t?this.bb.__vector_len(this.bb_pos+t):0}vertices(t,e){const n=this.bb.__offset(this.bb_pos,32);return n?(e||new om).__init(this.bb.__vector(this.bb_pos+n)+t*12,this.bb):null}verticesLength(){const t=this.bb.__offset(this.bb_pos,32);return t?this.bb.__vector_len(this.bb_pos+t):0}triangles(t,e){const n=this.bb.__offset(this.bb_pos,34);return n?(e||new vu).__init(this.bb.__vector(this.bb_pos+n)+t*12,this.bb):null}trianglesLength(){const t=this.bb.__offset(this.bb_pos,34);return t?this.bb.__vector_len(this.bb_pos+t):0}sphereNodes(t,e){const n=this.bb.__offset(this.bb_pos,36);return n?(e||new qg).__init(this.bb.__vector(this.bb_pos+n)+t*24,this.bb):null}sphereNodesLength(){const t=this.bb.__offset(this.bb_pos,36);return t?this.bb.__vector_len(this.bb_pos+t):0}provenance(t){const e=this.bb.__offset(this.bb_pos,38);return e?(t||new ss).__init(this.bb.__indirect(this.bb_pos+e),this.bb):null}mixed(t,e){const n=this.bb.__offset(this.bb_pos,40);return n?(e||new zg).__init(this.bb.__vector(this.bb_pos+n)+t*24,this.bb):null}mixedLength(){const t=this.bb.__offset(this.bb_pos,40);return t?this.bb.__vector_len(this.bb_pos+t):0}sheets(t){const e=this.bb.__offset(this.bb_pos,42);return e?(t||new rs).__init(this.bb.__indirect(this.bb_pos+e),this.bb):null}contentSha256(t){const e=this.bb.__offset(this.bb_pos,44);return e?this.bb.readUint8(this.bb.__vector(this.bb_pos+e)+t):0}contentSha256Length(){const t=this.bb.__offset(this.bb_pos,44);return t?this.bb.__vector_len(this.bb_pos+t):0}contentSha256Array(){const t=this.bb.__offset(this.bb_pos,44);return t?new Uint8Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}membranes(t){const e=this.bb.__offset(this.bb_pos,46);return e?(t||new is).__init(this.bb.__indirect(this.bb_pos+e),this.bb):null}slides(t){const e=this.bb.__offset(this.bb_pos,48);return e?(t||new os).__init(this.bb.__indirect(this.bb_pos+e),this.bb):null}levels(t){const e=this.bb.__offset(this.bb_pos,50);return e?(t||new ns).__init(this.bb.__indirect(this.bb_pos+e),this.bb):null}skins(t,e){const n=this.bb.__offset(this.bb_pos,52);return n?(e||new Wg).__init(this.bb.__vector(this.bb_pos+n)+t*8,this.bb):null}skinsLength(){const t=this.bb.__offset(this.bb_pos,52);return t?this.bb.__vector_len(this.bb_pos+t):0}static startOrgan(t){t.startObject(25)}static addFormatVersion(t,e){t.addFieldInt32(0,e,0)}static addName(t,e){t.addFieldOffset(1,e,0)}static addVoxelEdgeM(t,e){t.addFieldFloat32(2,e,0)}static addOriginXM(t,e){t.addFieldFloat32(3,e,0)}static addOriginYM(t,e){t.addFieldFloat32(4,e,0)}static addOriginZM(t,e){t.addFieldFloat32(5,e,0)}static addSizeX(t,e){t.addFieldInt16(6,e,0)}static addSizeY(t,e){t.addFieldInt16(7,e,0)}static addSizeZ(t,e){t.addFieldInt16(8,e,0)}static addRuns(t,e){t.addFieldOffset(9,e,0)}static startRunsVector(t,e){t.startVector(8,e,2)}static addVoxelMaterial(t,e){t.addFieldOffset(10,e,0)}static createVoxelMaterialVector(t,e){t.startVector(1,e.length,1);for(let n=e.length-1;n>=0;n--)t.addInt8(e[n]);return t.endVector()}static startVoxelMaterialVector(t,e){t.startVector(1,e,1)}static addVoxelFill(t,e){t.addFieldOffset(11,e,0)}static createVoxelFillVector(t,e){t.startVector(1,e.length,1);for(let n=e.length-1;n>=0;n--)t.addInt8(e[n]);return t.endVector()}static startVoxelFillVector(t,e){t.startVector(1,e,1)}static addVoxelFixed(t,e){t.addFieldOffset(12,e,0)}static createVoxelFixedVector(t,e){t.startVector(1,e.length,1);for(let n=e.length-1;n>=0;n--)t.addInt8(e[n]);return t.endVector()}static startVoxelFixedVector(t,e){t.startVector(1,e,1)}static addMaterials(t,e){t.addFieldOffset(13,e,0)}static createMaterialsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startMaterialsVector(t,e){t.startVector(4,e,4)}static addVertices(t,e){t.addFieldOffset(14,e,0)}static startVerticesVector(t,e){t.startVector(12,e,4)}static addTriangles(t,e){t.addFieldOffset(15,e,0)}static startTrianglesVector(t,e){t.startVector(12,e,4)}static addSphereNodes(t,e){t.addFieldOffset(16,e,0)}static startSphereNodesVector(t,e){t.startVector(24,e,4)}static addProvenance(t,e){t.addFieldOffset(17,e,0)}static addMixed(t,e){t.addFieldOffset(18,e,0)}static startMixedVector(t,e){t.startVector(24,e,4)}static addSheets(t,e){t.addFieldOffset(19,e,0)}static addContentSha256(t,e){t.addFieldOffset(20,e,0)}static createContentSha256Vector(t,e){t.startVector(1,e.length,1);for(let n=e.length-1;n>=0;n--)t.addInt8(e[n]);return t.endVector()}static startContentSha256Vector(t,e){t.startVector(1,e,1)}static addMembranes(t,e){t.addFieldOffset(21,e,0)}static addSlides(t,e){t.addFieldOffset(22,e,0)}static addLevels(t,e){t.addFieldOffset(23,e,0)}static addSkins(t,e){t.addFieldOffset(24,e,0)}static startSkinsVector(t,e){t.startVector(8,e,4)}static endOrgan(t){const e=t.endObject();return t.requiredField(e,22),t.requiredField(e,24),t.requiredField(e,26),t.requiredField(e,30),e}static finishOrganBuffer(t,e){t.finish(e,"STLO")}static finishSizePrefixedOrganBuffer(t,e){t.finish(e,"STLO",!0)}}const jg="STLO",$g=65535;class xu extends Error{}function Zg(i){const t=[],e=[],n=new rm,s=i.sheets()?.rows()||i.sizeY(),[r,o]=am(i),a=l=>l+o*(2**l-1);for(let l=0;l<i.runsLength();++l){i.runs(l,n);let c=0;for(;c+1<r&&n.z()>=a(c+1);)++c;const h=2**(r-1-c),[f,u,p]=[n.x(),n.y()%s,n.z()-a(c)];for(let _=0;_<n.count();++_)t.push(h*(f+_),h*u,h*p),e.push(h)}return[Uint16Array.from(t),Uint8Array.from(e)]}function am(i){const t=i.levels();return t?[t.count(),t.planes()]:[1,i.sizeZ()]}function Kg(i,t){const e=[i.originXM(),i.originYM(),i.originZM()],n=new om;for(let s=0;s<i.verticesLength();++s){i.vertices(s,n);const r=n.voxel();if(r>=t.voxelCount)throw new xu(`vertex ${s}: voxel ${r}`);t.vertexVoxel[s]=r,[n.fx(),n.fy(),n.fz()].forEach((o,a)=>{const l=o/$g;t.vertexFraction[3*s+a]=l,t.vertexRest[3*s+a]=e[a]+(t.voxelPlace[3*r+a]+l*t.voxelSize[r])*t.edge})}}function Jg(i,t){const e=new vu,n=i.verticesLength();for(let s=0;s<i.trianglesLength();++s)i.triangles(s,e),[e.a(),e.b(),e.c()].forEach((r,o)=>{if(r>=n)throw new xu(`triangle ${s}: vertex ${r}`);t.triangles[3*s+o]=r})}function Qg(i,t){const e=new Float32Array(i.length);for(let n=0;n<t.length;n+=3){const[s,r,o]=[3*t[n],3*t[n+1],3*t[n+2]],[a,l,c]=[0,1,2].map(_=>i[r+_]-i[s+_]),[h,f,u]=[0,1,2].map(_=>i[o+_]-i[s+_]),p=[l*u-c*f,c*h-a*u,a*f-l*h];for(const _ of[s,r,o])for(let b=0;b<3;++b)e[_+b]+=p[b]}for(let n=0;n<e.length;n+=3){const s=Math.hypot(e[n],e[n+1],e[n+2])||1;for(let r=0;r<3;++r)e[n+r]/=s}return e}function tb(i){const t=new co(new Uint8Array(i));if(i.byteLength<12||!t.__has_identifier(jg))throw new xu("no organ file");const e=gl.getRootAsOrgan(t),[n,s]=Zg(e),r={name:e.name()??"",edge:e.voxelEdgeM()/2**(am(e)[0]-1),voxelCount:n.length/3,voxelPlace:n,voxelSize:s,voxelMaterial:(e.voxelMaterialArray()??new Uint8Array).slice(),materials:[],vertexVoxel:new Uint32Array(e.verticesLength()),vertexFraction:new Float32Array(3*e.verticesLength()),vertexRest:new Float32Array(3*e.verticesLength()),vertexNormal:new Float32Array,triangles:new Uint32Array(3*e.trianglesLength())};for(let o=0;o<e.materialsLength();++o)r.materials.push(e.materials(o)?.name()??`${o}`);return Kg(e,r),Jg(e,r),r.vertexNormal=Qg(r.vertexRest,r.triangles),r}function eb(i,t){if(t.corners.length!==8*i.voxelCount)return`corners of ${t.corners.length/8} voxels, organ of ${i.voxelCount}`;if(t.rest.length!==3*t.particles)return`${t.rest.length/3} places of ${t.particles} particles`;const e=t.corners.find(n=>n>=t.particles);return e===void 0?"":`corner ${e} of ${t.particles} particles`}function nb(i){const t=new Set;for(let e=0;e<i.length;e+=3)for(let n=0;n<3;++n){const[s,r]=[i[e+n],i[e+(n+1)%3]],o=Math.min(s,r)*2**26+Math.max(s,r);t.delete(o)||t.add(o)}return t.size>0}function ib(i){const t=new Map,e=([s,r,o])=>s+1+65537*(r+1+65537*(o+1));for(let s=0;s<i.voxelCount;++s){const r=i.voxelSize[s];t.has(r)||t.set(r,new Set),t.get(r)?.add(e(i.voxelPlace.subarray(3*s,3*s+3)))}const n=(s,r)=>t.get(s)?.has(e(r))??!1;return(s,r,o,a)=>{if(n(r,s)||n(2*r,s.map(c=>c-c%(2*r))))return!0;const l=r/2;return[0,1,2,3].every(c=>{const h=[...s];return h[o]+=a===1?0:l,h[(o+1)%3]+=(c&1)*l,h[(o+2)%3]+=(c>>1)*l,n(l,h)})}}function sb(i,t){const e=ib(i),n=new Set,s=[],r=(o,a)=>{const l=Math.min(o,a)*67108864+Math.max(o,a);n.has(l)||(n.add(l),s.push(o,a))};for(let o=0;o<i.voxelCount;++o){const a=i.voxelSize[o];for(let l=0;l<3;++l)for(const c of[0,1]){const h=[...i.voxelPlace.subarray(3*o,3*o+3)];if(h[l]+=c===1?a:-a,e(h,a,l,c))continue;const f=1<<l,[u,p]=[1<<(l+1)%3,1<<(l+2)%3],_=b=>t[8*o+b+(c===1?f:0)];r(_(0),_(u)),r(_(0),_(p)),r(_(u),_(u+p)),r(_(p),_(u+p))}}return Uint32Array.from(s)}const rb={total:{colour:"#1d2733",dark:"#f2f5f8",dash:[]},stiffness:{colour:"#0072b2",dark:"#56b4e9",dash:[]},cutting:{colour:"#c24e00",dark:"#ff8c42",dash:[8,3]},friction:{colour:"#009e73",dark:"#1f9e7a",dash:[2,3]},clamping:{colour:"#a8478a",dark:"#d85fb0",dash:[10,3,2,3]},obstacle:{colour:"#5c3d00",dark:"#f5e6a8",dash:[4,4]}},{total:ob,...ab}=rb,bl=ab,Mu=ob,uc=["#cc6677","#ddcc77","#88ccee","#44aa99","#999933","#aa4499","#117733","#332288","#882255"],lb={liver:8,kidney:0,spleen:0,pancreas:0,stomach:0,prostate:0,gel:0,fat:1,epidural_fat:4,skin:2,liver_capsule:0,prostate_capsule:3,fascia:3,ligamentum_flavum:3,tumour:4,muscle:5,vessel:6,ligament:0,bone:2};function Tf(i,t,e){return`#${[1,3,5].map(r=>parseInt(i.slice(r,r+2),16)).map(r=>Math.round(r+e*(t-r))).map(r=>r.toString(16).padStart(2,"0")).join("")}`}const fc=[...uc,...uc.map(i=>Tf(i,255,.55)),...uc.map(i=>Tf(i,0,.45))];function yu(i){const t=new Set,e=i.map(r=>{const o=lb[r];return o===void 0||t.has(o)?-1:(t.add(o),o)}),n=fc.map((r,o)=>o).filter(r=>!t.has(r));let s=0;return e.map((r,o)=>fc[r>=0?r:n[s++]??o%fc.length])}const ln={needle:"#a9b4c2",handle:"#6f7b8a",lattice:"#b3261e",particle:"#2fa84f",goal:"#f0e442",obstacle:"#9aa3ad",target:"#0072b2",forbidden:"#d55e00",force:"#e69f00",inside:"#7c3b47"},vl={colour:"#6b7785",dark:"#93a0ae",dash:[5,3]},lm={colour:"#0072b2",dark:"#56b4e9",dash:[]},cm={colour:"#c24e00",dark:"#ff8c42",dash:[7,3]},cb=[Mu,vl,lm,cm,...Object.values(bl)],hb=(i,t)=>t?i.dark:i.colour,ub=i=>cb.find(t=>t.dark===i)?.colour??i,to=["tick","depth","travel","force","lateral","stiffness","cutting","friction","clamping","obstacle","tickUs","lateUs"];class hm{constructor(){this.length=0,this.columns=to.map(()=>new Float64Array(4096))}clear(){this.length=0}column(t){return this.columns[to.indexOf(t)].subarray(0,this.length)}find(t){const e=this.columns[0];let n=0,s=this.length;for(;n<s;){const r=n+s>>1;e[r]<t?n=r+1:s=r}return n}add(t){const e=this.find(t.tick);e<this.length&&this.columns[0][e]===t.tick||this.open(e),to.forEach((s,r)=>this.columns[r][e]=t[s])}near(t){if(this.length===0)return null;let e=Math.min(this.find(t),this.length-1);const n=this.columns[0];e>0&&t-n[e-1]<n[e]-t&&--e;const s=to.map((r,o)=>[r,this.columns[o][e]]);return Object.fromEntries(s)}open(t){if(this.length===this.columns[0].length&&(this.columns=this.columns.map(e=>{const n=new Float64Array(2*e.length);return n.set(e),n})),t<this.length)for(const e of this.columns)e.copyWithin(t+1,t,this.length);++this.length}}function um(i,t,e,n){const s=e-t;if(s<=4*n)return Array.from({length:Math.max(0,s)},(o,a)=>t+a);const r=[];for(let o=0;o<n;++o){const a=t+Math.floor(o*s/n),l=t+Math.floor((o+1)*s/n);let[c,h]=[a,a];for(let u=a;u<l;++u)i[u]<i[c]&&(c=u),i[u]>i[h]&&(h=u);const f=[a,Math.min(c,h),Math.max(c,h),l-1];for(const u of f)r[r.length-1]!==u&&r.push(u)}return r}function Qa(i){for(let t=1;t<9;++t){const e=i.toPrecision(t);if(Math.fround(Number(e))===Math.fround(i))return String(Number(e))}return String(Number(i.toPrecision(9)))}const fb=i=>`${Math.round(100*i)} %`,O={title:"Stylet console",brand:"Stylet",skip:"Skip to the 3D view",views:{trainee:"Trainee",teacher:"Teacher",engineer:"Engineer",report:"Report"},viewsLabel:"Views",language:"en",link:{connecting:"Connecting",open:"Connected",lost:i=>`Connection lost: this page shows nothing live. Next try in ${Math.max(0,Math.ceil(i))} s.`,trying:"Connection lost: this page shows nothing live. Trying again now.",retry:"Try now",protocol:(i,t)=>`The program uses protocol ${i}, this page protocol ${t}. Load the page again from the running program.`,reload:"Load again",garbled:"A message from the program could not be read and was skipped.",organ:i=>`The organ could not be shown: ${i}.`,webgl:"This browser has no WebGL 2: the page shows plots, but no 3D view.",waiting:"Waiting for the program"},session:{label:"Session",scene:"Scene",trainee:"Trainee",traineeHint:"Name or number",start:"Start",pause:"Pause",resume:"Resume",end:"End",reset:"Reset",acknowledge:"Acknowledge fault",activity:["Ready","Running","Paused","Ended","Recording"],watching:"Watching only: this connection may not control the session."},view3d:{label:"3D view",canvas:"3D view of organ and needle. Arrow keys turn the view, plus and minus move nearer and farther away, 1 to 5 choose a point of view.",toolbar:"What the 3D view shows",presets:{side:"Side",oblique:"Oblique",behind:"Behind the needle",above:"Above",tip:"Tip"},presetsLabel:"Point of view",surface:"Surface",xray:"X-ray",lattice:"Lattice",particles:"Particles",cut:"Cut open",cutAt:"Position of the cut",frameRate:i=>i>0?`${i} fps`:"at rest",frameRateLabel:"Frames drawn in the last second; at rest: nothing moves",legendParticle:"Constraint particle",legendGoal:"Its goal",legendLattice:"Voxel lattice",legendTarget:"Target",legendForbidden:"Forbidden zone",legendForce:"Force on the hand",legend:"Legend"},force:{heading:"Force",onHand:"Force on the hand",gauge:(i,t)=>`${i.toFixed(2)} of at most ${t.toFixed(1)} newtons`,depth:"Depth in tissue",phase:"Phase",layer:"Tissue at the tip",outside:"outside",phases:["Free","Contact","Inserted","Retracting"],atCursor:"At the cursor, as recorded",now:"Now",tick:"Tick",time:"Time",vector:"Force x, y, z",axial:"Along the needle",lateral:"Across",needle:"Needle",needleNumber:i=>`Needle ${i+1}`,causes:{stiffness:"Surface",cutting:"Cutting",friction:"Friction",clamping:"Clamping",obstacle:"Obstacle"},total:"Sum",fault:i=>`Fault: ${i}`},plots:{time:"Force against time",depth:"Force against depth",timeAxis:"Time in s",depthAxis:"Depth in mm",forceAxis:"Force in N",byCause:"By cause",whole:"Whole attempt",window:"Last 20 s",exportLabel:i=>`Save: ${i}`,png:"PNG",svg:"SVG",csv:"CSV",empty:"No ticks yet",description:(i,t,e)=>`${i}: ${t} values, at most ${e.toFixed(2)} N in magnitude.`,keyboard:"Left and right arrows move the cursor.",events:["Contact","Release","Puncture","Re-entry","Exit","Layer","Obstacle"],mark:"Mark",legend:"Curves"},loop:{heading:"Loop",tick:"Duration of a tick",late:"Lateness",ticksAxis:"Ticks",usAxis:"us",quantile:"Quantile",quantiles:["50 %","90 %","99 %","99.9 %","largest"],counts:{ticks:"Ticks",missed:"Missed ticks",lostRecords:"Records lost",lostFrames:"Frames lost here",connections:"Connections"},page:"This page",parts:{message:"Read a frame",deform:"Deform",bodies:"Needle and particles",caps:"Faces of the cut",face:"Skip faces turned away",draw:"Draw",plots:"Plots"},ms:i=>`${i.toFixed(1)} ms`,guard:"Guard",command:"Force sent to the device",flags:"Flags",flagNames:["input not finite","input clamped","input missing","constraint particle pool full","voxel pool full","contact budget","obstacle pool full","needle unstable"],kernelFault:"kernel fault",none:"none",particles:"Constraint particles",voxels:(i,t)=>`${i.toLocaleString("en")} voxels, ${t.toLocaleString("en")} triangles`},playback:{heading:"Recording",position:"Position in the recording",play:"Play",hold:"Pause",back:"One tick back",forward:"One tick forward",speed:"Speed",speedOf:i=>i===1?"as recorded":`${i} x`,at:(i,t)=>`${i} of ${t} s`,nextEvent:"Next event",lastEvent:"Previous event"},marks:{heading:"Marks",label:"Note at this moment",hint:"What you saw",add:"Mark",none:"No marks yet.",goTo:(i,t)=>`${i} s: ${t}`},scores:{heading:"Score card",none:"The score card is filled when an attempt ends.",attempt:i=>`Attempt ${i}`,lines:{trainee:"Trainee",began:"Began",duration:"Duration",path:"Path of the tip",depthPath:"part of it in tissue",punctures:"Punctures",withdrawals:"Withdrawals",targets:"Targets reached",forbidden:"Forbidden zones touched",closest:"Closest to a target",peakForce:"Peak force",peakLateral:"Peak sideways force",meanForce:"Mean force in tissue",faults:"Faults of the guard",recording:"Recording"},of:(i,t)=>`${i} of ${t}`,puncture:(i,t)=>`${i} at ${t}`,notKept:"not saved",dash:"-"},compare:{heading:"Comparison",first:"First",second:"Second",difference:"Difference",what:"Quantity",need:"After two finished attempts, they can be compared here.",plot:"Force against depth, two attempts"},report:{heading:"Session report",print:"Print",made:i=>`Made ${i}`,version:i=>`stylet ${i}`,attempts:"Attempts",curves:"Force against time",marks:"Teacher's marks",targets:"Targets and zones",none:"No attempt was finished in this session.",target:"Target",kind:"Kind",kinds:{target:"target",forbidden:"forbidden zone"},closest:"Closest",reached:"Reached",yes:"yes",no:"no",signature:"Signature of the teacher"},pointer:{heading:"Needle held by mouse or finger",hold:"Hold the needle",letGo:"Let go",help:"Drag up to push and down to pull, drag sideways to move sideways, turn the wheel to roll. Keys: W and S push and pull, A and D move sideways, R and F up and down, Q and E roll; hold Shift to move slowly.",pad:"Needle: drag up to push, down to pull; keys W S A D R F Q E",advance:i=>i<0?`Tip ${(-i).toFixed(1)} mm before the skin`:`Tip ${i.toFixed(1)} mm past the skin`,roll:i=>`Roll ${i.toFixed(0)} deg`,home:"Back to the start"},help:{open:"Keys",heading:"Keys",close:"Close",keys:[["Tab, Shift+Tab","next and previous control"],["Alt+1 to Alt+4","trainee, teacher, engineer, report"],["Space","start, pause, resume; in a recording: play and pause"],["M","write a note at this moment (a mark)"],["Arrows","in the 3D view: turn; in a plot or on the scrub bar: move the cursor"],["+ and -","in the 3D view: nearer, farther away"],["1 to 5","in the 3D view: side, oblique, behind, above, tip"],["X, L, P, C","in the 3D view: x-ray, lattice, particles, cut"],["W S A D R F Q E","on the needle pad: push, pull, sideways, up, down, roll"],["?","show these keys"]]},units:{n:(i,t=2)=>`${i.toFixed(t)} N`,mm:(i,t=1)=>`${(1e3*i).toFixed(t)} mm`,s:(i,t=1)=>`${i.toFixed(t)} s`,us:i=>`${i.toFixed(0)} us`,percent:fb}},dc=3,Af=i=>Math.hypot(i.x,i.y,i.z);class db{constructor(t){this.store=t,this.big=tt("output",{class:"big"}),this.bar=tt("div",{class:"bar-fill"}),this.meter=tt("div",{class:"bar",role:"meter","aria-label":O.force.onHand},this.bar),this.facts=tt("dl",{class:"facts"}),this.causes=tt("ul",{class:"causes"}),this.fault=tt("p",{class:"fault",role:"alert",hidden:!0}),this.choice=tt("select"),this.choiceField=ta(O.force.needle,this.choice),this.cells=new Map;const e=tt("dl",{class:"facts exact","data-in":"teacher engineer"});this.addFacts(this.facts,["depth","phase","layer"]),this.addFacts(e,["tick","time","vector","axial","lateral"]);for(const n of fh)this.causes.append(this.causeBar(n));this.causes.dataset.in="engineer",this.root=Ns("force",O.force.heading,"trainee teacher engineer",this.choiceField,tt("div",{class:"gauge"},this.big,this.meter),this.fault,this.facts,this.causes,e),this.choice.addEventListener("change",()=>{t.needle=Number(this.choice.value),t.tell("needle")}),t.on(["hello"],()=>this.begin()),t.on(["frame","needle","rows","organ"],()=>this.show())}addFacts(t,e){for(const n of e){const s=tt("dd",{"data-value":n});this.cells.set(n,s),t.append(tt("div",{},tt("dt",{},O.force[n]),s))}}causeBar(t){const e=tt("span",{class:"cause-value"}),n=tt("span",{class:"cause-fill"});return n.style.setProperty("--light",bl[t].colour),n.style.setProperty("--dark",bl[t].dark),this.cells.set(t,e),this.cells.set(`${t}-fill`,n),tt("li",{},tt("span",{},O.force.causes[t]),tt("span",{class:"cause-bar"},n),e)}begin(){const t=this.store.hello?.needles??[];this.choice.replaceChildren(...t.map((e,n)=>tt("option",{value:n},O.force.needleNumber(n)))),this.choice.value=String(this.store.needle),this.choiceField.hidden=t.length<2}show(){const{frame:t,hello:e,needle:n}=this.store,s=t?.needles[n],r=e?.needles[n];if(!t||!s||!r)return;const o=r.maxForce>0?r.maxForce:10,a=Af(s.force);xn(this.big,O.units.n(a));const l=Math.min(1,a/o);this.bar.style.transform=`scaleX(${l.toFixed(4)})`,this.meter.dataset.level=l>.9?"high":l>.6?"raised":"low",this.meter.setAttribute("aria-valuemin","0"),this.meter.setAttribute("aria-valuemax",o.toFixed(1)),this.meter.setAttribute("aria-valuenow",a.toFixed(2)),this.meter.setAttribute("aria-valuetext",O.force.gauge(a,o)),xn(this.fault,s.fault===""?"":O.force.fault(s.fault)),this.fault.hidden=s.fault==="",this.showFacts(s,o)}put(t,e){const n=this.cells.get(t);n&&xn(n,e)}tellExactly(t,e){const n=this.cells.get(t);n&&n.title!==e&&(n.title=e)}showFacts(t,e){const{frame:n,hello:s,needle:r}=this.store,o=s?.needles[r]?.direction;if(!n||!o)return;this.put("depth",O.units.mm(t.depth)),this.put("phase",O.force.phases[t.phase]??""),this.put("layer",t.layer===_g?O.force.outside:this.store.layerName(t.layer)),this.put("tick",String(n.tick)),this.put("time",O.units.s(this.store.seconds(n.tick),3));const{x:a,y:l,z:c}=t.force;this.put("vector",`${[a,l,c].map(p=>p.toFixed(dc)).join(", ")} N`),this.tellExactly("vector",`${[a,l,c].map(Qa).join(", ")} N`);const h=p=>p.x*o.x+p.y*o.y+p.z*o.z,f=this.store.rows.near(n.tick),u=f!==null&&f.tick===n.tick;this.put("axial",O.units.n(u?f.force:-h(t.force),dc)),this.tellExactly("axial",u?`${Qa(f.force)} N`:""),this.put("lateral",u?O.units.n(f.lateral,dc):O.scores.dash),this.tellExactly("lateral",u?`${Qa(f.lateral)} N`:"");for(const p of fh){const _=Af(t.causes[p]);this.put(p,O.units.n(_));const b=this.cells.get(`${p}-fill`);b&&(b.style.transform=`scaleX(${Math.min(1,_/e).toFixed(4)})`)}}}const pb=!0,fn="u-",mb="uplot",_b=fn+"hz",gb=fn+"vt",bb=fn+"title",vb=fn+"wrap",xb=fn+"under",Mb=fn+"over",yb=fn+"axis",rr=fn+"off",Sb=fn+"select",wb=fn+"cursor-x",Eb=fn+"cursor-y",Tb=fn+"cursor-pt",Ab=fn+"legend",Rb=fn+"live",Pb=fn+"inline",Cb=fn+"series",Lb=fn+"marker",Rf=fn+"label",Ib=fn+"value",Yo="width",qo="height",Uo="top",Pf="bottom",Ir="left",pc="right",Su="#000",Cf=Su+"0",mc="mousemove",Lf="mousedown",_c="mouseup",If="mouseenter",Ff="mouseleave",Df="dblclick",Fb="resize",Db="scroll",Uf="change",xl="dppxchange",wu="--",So=typeof window<"u",mh=So?document:null,io=So?window:null,Ub=So?navigator:null;let xe,ba;function _h(){let i=devicePixelRatio;xe!=i&&(xe=i,ba&&bh(Uf,ba,_h),ba=matchMedia(`(min-resolution: ${xe-.001}dppx) and (max-resolution: ${xe+.001}dppx)`),ur(Uf,ba,_h),io.dispatchEvent(new CustomEvent(xl)))}function Kn(i,t){if(t!=null){let e=i.classList;!e.contains(t)&&e.add(t)}}function gh(i,t){let e=i.classList;e.contains(t)&&e.remove(t)}function ke(i,t,e){i.style[t]=e+"px"}function xi(i,t,e,n){let s=mh.createElement(i);return t!=null&&Kn(s,t),e?.insertBefore(s,n),s}function ai(i,t){return xi("div",i,t)}const Nf=new WeakMap;function Ui(i,t,e,n,s){let r="translate("+t+"px,"+e+"px)",o=Nf.get(i);r!=o&&(i.style.transform=r,Nf.set(i,r),t<0||e<0||t>n||e>s?Kn(i,rr):gh(i,rr))}const Of=new WeakMap;function kf(i,t,e){let n=t+e,s=Of.get(i);n!=s&&(Of.set(i,n),i.style.background=t,i.style.borderColor=e)}const Bf=new WeakMap;function zf(i,t,e,n){let s=t+""+e,r=Bf.get(i);s!=r&&(Bf.set(i,s),i.style.height=e+"px",i.style.width=t+"px",i.style.marginLeft=n?-t/2+"px":0,i.style.marginTop=n?-e/2+"px":0)}const Eu={passive:!0},Nb={...Eu,capture:!0};function ur(i,t,e,n){t.addEventListener(i,e,n?Nb:Eu)}function bh(i,t,e,n){t.removeEventListener(i,e,Eu)}So&&_h();function yi(i,t,e,n){let s;e=e||0,n=n||t.length-1;let r=n<=2147483647;for(;n-e>1;)s=r?e+n>>1:Qn((e+n)/2),t[s]<i?e=s:n=s;return i-t[e]<=t[n]-i?e:n}function fm(i){return(e,n,s)=>{let r=-1,o=-1;for(let a=n;a<=s;a++)if(i(e[a])){r=a;break}for(let a=s;a>=n;a--)if(i(e[a])){o=a;break}return[r,o]}}const dm=i=>i!=null,pm=i=>i!=null&&i>0,Ul=fm(dm),Ob=fm(pm);function kb(i,t,e,n=0,s=!1){let r=s?Ob:Ul,o=s?pm:dm;[t,e]=r(i,t,e);let a=i[t],l=i[t];if(t>-1)if(n==1)a=i[t],l=i[e];else if(n==-1)a=i[e],l=i[t];else for(let c=t;c<=e;c++){let h=i[c];o(h)&&(h<a?a=h:h>l&&(l=h))}return[a??Le,l??-Le]}function Nl(i,t,e,n){let s=Gf(i),r=Gf(t);i==t&&(s==-1?(i*=e,t/=e):(i/=e,t*=e));let o=e==10?fs:mm,a=s==1?Qn:li,l=r==1?li:Qn,c=a(o(an(i))),h=l(o(an(t))),f=ho(e,c),u=ho(e,h);return e==10&&(c<0&&(f=Ie(f,-c)),h<0&&(u=Ie(u,-h))),n||e==2?(i=f*s,t=u*r):(i=vm(i,f),t=Ol(t,u)),[i,t]}function Tu(i,t,e,n){let s=Nl(i,t,e,n);return i==0&&(s[0]=0),t==0&&(s[1]=0),s}const Au=.1,Vf={mode:3,pad:Au},Ko={pad:0,soft:null,mode:0},Bb={min:Ko,max:Ko};function Ml(i,t,e,n){return kl(e)?Hf(i,t,e):(Ko.pad=e,Ko.soft=n?0:null,Ko.mode=n?3:0,Hf(i,t,Bb))}function ge(i,t){return i??t}function zb(i,t,e){for(t=ge(t,0),e=ge(e,i.length-1);t<=e;){if(i[t]!=null)return!0;t++}return!1}function Hf(i,t,e){let n=e.min,s=e.max,r=ge(n.pad,0),o=ge(s.pad,0),a=ge(n.hard,-Le),l=ge(s.hard,Le),c=ge(n.soft,Le),h=ge(s.soft,-Le),f=ge(n.mode,0),u=ge(s.mode,0),p=t-i,_=fs(p),b=Bn(an(i),an(t)),m=fs(b),d=an(m-_);(p<1e-24||d>10)&&(p=0,(i==0||t==0)&&(p=1e-24,f==2&&c!=Le&&(r=0),u==2&&h!=-Le&&(o=0)));let M=p||b||1e3,w=fs(M),v=ho(10,Qn(w)),U=M*(p==0?i==0?.1:1:r),P=Ie(vm(i-U,v/10),24),L=i>=c&&(f==1||f==3&&P<=c||f==2&&P>=c)?c:Le,F=Bn(a,P<L&&i>=L?L:wi(L,P)),S=M*(p==0?t==0?.1:1:o),x=Ie(Ol(t+S,v/10),24),A=t<=h&&(u==1||u==3&&x>=h||u==2&&x<=h)?h:-Le,V=wi(l,x>A&&t<=A?A:Bn(A,x));return F==V&&F==0&&(V=100),[F,V]}const Vb=new Intl.NumberFormat(So?Ub.language:"en-US"),Ru=i=>Vb.format(i),ti=Math,tl=ti.PI,an=ti.abs,Qn=ti.floor,on=ti.round,li=ti.ceil,wi=ti.min,Bn=ti.max,ho=ti.pow,Gf=ti.sign,fs=ti.log10,mm=ti.log2,Hb=(i,t=1)=>ti.sinh(i)*t,gc=(i,t=1)=>ti.asinh(i/t),Le=1/0;function Wf(i){return(fs((i^i>>31)-(i>>31))|0)+1}function vh(i,t,e){return wi(Bn(i,t),e)}function _m(i){return typeof i=="function"}function ae(i){return _m(i)?i:()=>i}const Gb=()=>{},gm=i=>i,bm=(i,t)=>t,Wb=i=>null,Xf=i=>!0,Yf=(i,t)=>i==t,Xb=/\.\d*?(?=9{6,}|0{6,})/gm,pr=i=>{if(Mm(i)||Fs.has(i))return i;const t=`${i}`,e=t.match(Xb);if(e==null)return i;let n=e[0].length-1;if(t.indexOf("e-")!=-1){let[s,r]=t.split("e");return+`${pr(s)}e${r}`}return Ie(i,n)};function Zs(i,t){return pr(Ie(pr(i/t))*t)}function Ol(i,t){return pr(li(pr(i/t))*t)}function vm(i,t){return pr(Qn(pr(i/t))*t)}function Ie(i,t=0){if(Mm(i))return i;let e=10**t,n=i*e*(1+Number.EPSILON);return on(n)/e}const Fs=new Map;function xm(i){return((""+i).split(".")[1]||"").length}function ea(i,t,e,n){let s=[],r=n.map(xm);for(let o=t;o<e;o++){let a=an(o),l=Ie(ho(i,o),a);for(let c=0;c<n.length;c++){let h=i==10?+`${n[c]}e${o}`:n[c]*l,f=(o>=0?0:a)+(o>=r[c]?0:r[c]),u=i==10?h:Ie(h,f);s.push(u),Fs.set(u,f)}}return s}const Jo={},Pu=[],uo=[null,null],Cs=Array.isArray,Mm=Number.isInteger,Yb=i=>i===void 0;function qf(i){return typeof i=="string"}function kl(i){let t=!1;if(i!=null){let e=i.constructor;t=e==null||e==Object}return t}function qb(i){return i!=null&&typeof i=="object"}const jb=Object.getPrototypeOf(Uint8Array),ym="__proto__";function fo(i,t=kl){let e;if(Cs(i)){let n=i.find(s=>s!=null);if(Cs(n)||t(n)){e=Array(i.length);for(let s=0;s<i.length;s++)e[s]=fo(i[s],t)}else e=i.slice()}else if(i instanceof jb)e=i.slice();else if(t(i)){e={};for(let n in i)n!=ym&&(e[n]=fo(i[n],t))}else e=i;return e}function Qe(i){let t=arguments;for(let e=1;e<t.length;e++){let n=t[e];for(let s in n)s!=ym&&(kl(i[s])?Qe(i[s],fo(n[s])):i[s]=fo(n[s]))}return i}const $b=0,Zb=1,Kb=2;function Jb(i,t,e){for(let n=0,s,r=-1;n<t.length;n++){let o=t[n];if(o>r){for(s=o-1;s>=0&&i[s]==null;)i[s--]=null;for(s=o+1;s<e&&i[s]==null;)i[r=s++]=null}}}function Qb(i,t){if(n0(i)){let o=i[0].slice();for(let a=1;a<i.length;a++)o.push(...i[a].slice(1));return i0(o[0])||(o=e0(o)),o}let e=new Set;for(let o=0;o<i.length;o++){let l=i[o][0],c=l.length;for(let h=0;h<c;h++)e.add(l[h])}let n=[Array.from(e).sort((o,a)=>o-a)],s=n[0].length,r=new Map;for(let o=0;o<s;o++)r.set(n[0][o],o);for(let o=0;o<i.length;o++){let a=i[o],l=a[0];for(let c=1;c<a.length;c++){let h=a[c],f=Array(s).fill(void 0),u=t?t[o][c]:Zb,p=[];for(let _=0;_<h.length;_++){let b=h[_],m=r.get(l[_]);b===null?u!=$b&&(f[m]=b,u==Kb&&p.push(m)):f[m]=b}Jb(f,p,s),n.push(f)}}return n}const t0=typeof queueMicrotask>"u"?i=>Promise.resolve().then(i):queueMicrotask;function e0(i){let t=i[0],e=t.length,n=Array(e);for(let r=0;r<n.length;r++)n[r]=r;n.sort((r,o)=>t[r]-t[o]);let s=[];for(let r=0;r<i.length;r++){let o=i[r],a=Array(e);for(let l=0;l<e;l++)a[l]=o[n[l]];s.push(a)}return s}function n0(i){let t=i[0][0],e=t.length;for(let n=1;n<i.length;n++){let s=i[n][0];if(s.length!=e)return!1;if(s!=t){for(let r=0;r<e;r++)if(s[r]!=t[r])return!1}}return!0}function i0(i,t=100){const e=i.length;if(e<=1)return!0;let n=0,s=e-1;for(;n<=s&&i[n]==null;)n++;for(;s>=n&&i[s]==null;)s--;if(s<=n)return!0;const r=Bn(1,Qn((s-n+1)/t));for(let o=i[n],a=n+r;a<=s;a+=r){const l=i[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}const Sm=["January","February","March","April","May","June","July","August","September","October","November","December"],wm=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Em(i){return i.slice(0,3)}const s0=wm.map(Em),r0=Sm.map(Em),o0={MMMM:Sm,MMM:r0,WWWW:wm,WWW:s0};function No(i){return(i<10?"0":"")+i}function a0(i){return(i<10?"00":i<100?"0":"")+i}const l0={YYYY:i=>i.getFullYear(),YY:i=>(i.getFullYear()+"").slice(2),MMMM:(i,t)=>t.MMMM[i.getMonth()],MMM:(i,t)=>t.MMM[i.getMonth()],MM:i=>No(i.getMonth()+1),M:i=>i.getMonth()+1,DD:i=>No(i.getDate()),D:i=>i.getDate(),WWWW:(i,t)=>t.WWWW[i.getDay()],WWW:(i,t)=>t.WWW[i.getDay()],HH:i=>No(i.getHours()),H:i=>i.getHours(),h:i=>{let t=i.getHours();return t==0?12:t>12?t-12:t},AA:i=>i.getHours()>=12?"PM":"AM",aa:i=>i.getHours()>=12?"pm":"am",a:i=>i.getHours()>=12?"p":"a",mm:i=>No(i.getMinutes()),m:i=>i.getMinutes(),ss:i=>No(i.getSeconds()),s:i=>i.getSeconds(),fff:i=>a0(i.getMilliseconds())};function Cu(i,t){t=t||o0;let e=[],n=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=n.exec(i);)e.push(s[0][0]=="{"?l0[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<e.length;a++)o+=typeof e[a]=="string"?e[a]:e[a](r,t);return o}}const c0=new Intl.DateTimeFormat().resolvedOptions().timeZone;function h0(i,t){let e;return t=="UTC"||t=="Etc/UTC"?e=new Date(+i+i.getTimezoneOffset()*6e4):t==c0?e=i:(e=new Date(i.toLocaleString("en-US",{timeZone:t})),e.setMilliseconds(i.getMilliseconds())),e}const Tm=i=>i%1==0,yl=[1,2,2.5,5],u0=ea(10,-32,0,yl),Am=ea(10,0,32,yl),f0=Am.filter(Tm),Ks=u0.concat(Am),Lu=`
`,Rm="{YYYY}",jf=Lu+Rm,Pm="{M}/{D}",jo=Lu+Pm,va=jo+"/{YY}",Cm="{aa}",d0="{h}:{mm}",$r=d0+Cm,$f=Lu+$r,Zf=":{ss}",ye=null;function Lm(i){let t=i*1e3,e=t*60,n=e*60,s=n*24,r=s*30,o=s*365,l=(i==1?ea(10,0,3,yl).filter(Tm):ea(10,-3,0,yl)).concat([t,t*5,t*10,t*15,t*30,e,e*5,e*10,e*15,e*30,n,n*2,n*3,n*4,n*6,n*8,n*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]);const c=[[o,Rm,ye,ye,ye,ye,ye,ye,1],[s*28,"{MMM}",jf,ye,ye,ye,ye,ye,1],[s,Pm,jf,ye,ye,ye,ye,ye,1],[n,"{h}"+Cm,va,ye,jo,ye,ye,ye,1],[e,$r,va,ye,jo,ye,ye,ye,1],[t,Zf,va+" "+$r,ye,jo+" "+$r,ye,$f,ye,1],[i,Zf+".{fff}",va+" "+$r,ye,jo+" "+$r,ye,$f,ye,1]];function h(f){return(u,p,_,b,m,d)=>{let M=[],w=m>=o,v=m>=r&&m<o,U=f(_),P=Ie(U*i,3),L=bc(U.getFullYear(),w?0:U.getMonth(),v||w?1:U.getDate()),F=Ie(L*i,3);if(v||w){let S=v?m/r:0,x=w?m/o:0,A=P==F?P:Ie(bc(L.getFullYear()+x,L.getMonth()+S,1)*i,3),V=new Date(on(A/i)),N=V.getFullYear(),Y=V.getMonth();for(let X=0;A<=b;X++){let J=bc(N+x*X,Y+S*X,1),K=J-f(Ie(J*i,3));A=Ie((+J+K)*i,3),A<=b&&M.push(A)}}else{let S=m>=s?s:m,x=Qn(_)-Qn(P),A=F+x+Ol(P-F,S);M.push(A);let V=f(A),N=V.getHours()+V.getMinutes()/e+V.getSeconds()/n,Y=m/n,X=u.axes[p]._space,J=d/X;for(;A=Ie(A+m,i==1?0:3),!(A>b);)if(Y>1){let K=Qn(Ie(N+Y,6))%24,ht=f(A).getHours()-K;ht>1&&(ht=-1),A-=ht*n,N=(N+Y)%24;let _t=M[M.length-1];Ie((A-_t)/m,3)*J>=.7&&M.push(A)}else M.push(A)}return M}}return[l,c,h]}const[p0,m0,_0]=Lm(1),[g0,b0,v0]=Lm(.001);ea(2,-53,53,[1]);function Kf(i,t){return i.map(e=>e.map((n,s)=>s==0||s==8||n==null?n:t(s==1||e[8]==0?n:e[1]+n)))}function Jf(i,t){return(e,n,s,r,o)=>{let a=t.find(_=>o>=_[0])||t[t.length-1],l,c,h,f,u,p;return n.map(_=>{let b=i(_),m=b.getFullYear(),d=b.getMonth(),M=b.getDate(),w=b.getHours(),v=b.getMinutes(),U=b.getSeconds(),P=m!=l&&a[2]||d!=c&&a[3]||M!=h&&a[4]||w!=f&&a[5]||v!=u&&a[6]||U!=p&&a[7]||a[1];return l=m,c=d,h=M,f=w,u=v,p=U,P(b)})}}function x0(i,t){let e=Cu(t);return(n,s,r,o,a)=>s.map(l=>e(i(l)))}function bc(i,t,e){return new Date(i,t,e)}function Qf(i,t){return t(i)}const M0="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function td(i,t){return(e,n,s,r)=>r==null?wu:t(i(n))}function y0(i,t){let e=i.series[t];return e.width?e.stroke(i,t):e.points.width?e.points.stroke(i,t):null}function S0(i,t){return i.series[t].fill(i,t)}const w0={show:!0,live:!0,isolate:!1,mount:Gb,markers:{show:!0,width:2,stroke:y0,fill:S0,dash:"solid"},idx:null,idxs:null,values:[]};function E0(i,t){let e=i.cursor.points,n=ai(),s=e.size(i,t);ke(n,Yo,s),ke(n,qo,s);let r=s/-2;ke(n,"marginLeft",r),ke(n,"marginTop",r);let o=e.width(i,t,s);return o&&ke(n,"borderWidth",o),n}function T0(i,t){let e=i.series[t].points;return e._fill||e._stroke}function A0(i,t){let e=i.series[t].points;return e._stroke||e._fill}function R0(i,t){return i.series[t].points.size}const vc=[0,0];function P0(i,t,e){return vc[0]=t,vc[1]=e,vc}function xa(i,t,e,n=!0){return s=>{s.button==0&&(!n||s.target==t)&&e(s)}}function xc(i,t,e,n=!0){return s=>{(!n||s.target==t)&&e(s)}}const C0={show:!0,x:!0,y:!0,lock:!1,move:P0,points:{one:!1,show:E0,size:R0,width:0,stroke:A0,fill:T0},bind:{mousedown:xa,mouseup:xa,click:xa,dblclick:xa,mousemove:xc,mouseleave:xc,mouseenter:xc},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(i,t)=>{t.stopPropagation(),t.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(i,t,e,n,s)=>n-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Im={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Iu=Qe({},Im,{filter:bm}),Fm=Qe({},Iu,{size:10}),Dm=Qe({},Im,{show:!1}),Fu='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',Um="bold "+Fu,Nm=1.5,ed={show:!0,scale:"x",stroke:Su,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Um,side:2,grid:Iu,ticks:Fm,border:Dm,font:Fu,lineGap:Nm,rotate:0},L0="Value",I0="Time",nd={show:!0,scale:"x",auto:!1,sorted:1,min:Le,max:-Le,idxs:[]};function F0(i,t,e,n,s){return t.map(r=>r==null?"":Ru(r))}function D0(i,t,e,n,s,r,o){let a=[],l=Fs.get(s)||0;e=o?e:Ie(Ol(e,s),l);for(let c=e;c<=n;c=Ie(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function xh(i,t,e,n,s,r,o){const a=[],l=i.scales[i.axes[t].scale].log,c=l==10?fs:mm,h=Qn(c(e));s=ho(l,h),l==10&&(s=Ks[yi(s,Ks)]);let f=e,u=s*l;l==10&&(u=Ks[yi(u,Ks)]);do a.push(f),f=f+s,l==10&&!Fs.has(f)&&(f=Ie(f,Fs.get(s))),f>=u&&(s=f,u=s*l,l==10&&(u=Ks[yi(u,Ks)]));while(f<=n);return a}function U0(i,t,e,n,s,r,o){let l=i.scales[i.axes[t].scale].asinh,c=n>l?xh(i,t,Bn(l,e),n,s):[l],h=n>=0&&e<=0?[0]:[];return(e<-l?xh(i,t,Bn(l,-n),-e,s):[l]).reverse().map(u=>-u).concat(h,c)}const Om=/./,N0=/[12357]/,O0=/[125]/,id=/1/,Mh=(i,t,e,n)=>i.map((s,r)=>t==4&&s==0||r%n==0&&e.test(s.toExponential()[s<0?1:0])?s:null);function k0(i,t,e,n,s){let r=i.axes[e],o=r.scale,a=i.scales[o],l=i.valToPos,c=r._space,h=l(10,o),f=l(9,o)-h>=c?Om:l(7,o)-h>=c?N0:l(5,o)-h>=c?O0:id;if(f==id){let u=an(l(1,o)-h);if(u<c)return Mh(t.slice().reverse(),a.distr,f,li(c/u)).reverse()}return Mh(t,a.distr,f,1)}function B0(i,t,e,n,s){let r=i.axes[e],o=r.scale,a=r._space,l=i.valToPos,c=an(l(1,o)-l(2,o));return c<a?Mh(t.slice().reverse(),3,Om,li(a/c)).reverse():t}function z0(i,t,e,n){return n==null?wu:t==null?"":Ru(t)}const sd={show:!0,scale:"y",stroke:Su,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Um,side:3,grid:Iu,ticks:Fm,border:Dm,font:Fu,lineGap:Nm,rotate:0};function V0(i,t){let e=3+(i||1)*2;return Ie(e*t,3)}function H0(i,t){let{scale:e,idxs:n}=i.series[0],s=i._data[0],r=i.valToPos(s[n[0]],e,!0),o=i.valToPos(s[n[1]],e,!0),a=an(o-r),l=i.series[t],c=a/(l.points.space*xe);return n[1]-n[0]<=c}const rd={scale:null,auto:!0,sorted:0,min:Le,max:-Le},km=(i,t,e,n,s)=>s,od={show:!0,auto:!0,sorted:0,gaps:km,alpha:1,facets:[Qe({},rd,{scale:"x"}),Qe({},rd,{scale:"y"})]},ad={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:km,alpha:1,points:{show:H0,filter:null},values:null,min:Le,max:-Le,idxs:[],path:null,clip:null};function G0(i,t,e,n,s){return e/10}const Bm={time:pb,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},W0=Qe({},Bm,{time:!1,ori:1}),ld={};function zm(i,t){let e=ld[i];return e||(e={key:i,plots:[],sub(n){e.plots.push(n)},unsub(n){e.plots=e.plots.filter(s=>s!=n)},pub(n,s,r,o,a,l,c){for(let h=0;h<e.plots.length;h++)e.plots[h]!=s&&e.plots[h].pub(n,s,r,o,a,l,c)}},i!=null&&(ld[i]=e)),e}const po=1,yh=2;function gr(i,t,e){const n=i.mode,s=i.series[t],r=n==2?i._data[t]:i._data,o=i.scales,a=i.bbox;let l=r[0],c=n==2?r[1]:r[t],h=n==2?o[s.facets[0].scale]:o[i.series[0].scale],f=n==2?o[s.facets[1].scale]:o[s.scale],u=a.left,p=a.top,_=a.width,b=a.height,m=i.valToPosH,d=i.valToPosV;return h.ori==0?e(s,l,c,h,f,m,d,u,p,_,b,zl,wo,Hl,Hm,Wm):e(s,l,c,h,f,d,m,p,u,b,_,Vl,Eo,Nu,Gm,Xm)}function Du(i,t){let e=0,n=0,s=ge(i.bands,Pu);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==t?e=o.dir:o.series[1]==t&&(o.dir==1?n|=1:n|=2)}return[e,n==1?-1:n==2?1:n==3?2:0]}function X0(i,t,e,n,s){let r=i.mode,o=i.series[t],a=r==2?o.facets[1].scale:o.scale,l=i.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function ds(i,t,e,n,s,r){return gr(i,t,(o,a,l,c,h,f,u,p,_,b,m)=>{let d=o.pxRound;const M=c.dir*(c.ori==0?1:-1),w=c.ori==0?wo:Eo;let v,U;M==1?(v=e,U=n):(v=n,U=e);let P=d(f(a[v],c,b,p)),L=d(u(l[v],h,m,_)),F=d(f(a[U],c,b,p)),S=d(u(r==1?h.max:h.min,h,m,_)),x=new Path2D(s);return w(x,F,S),w(x,P,S),w(x,P,L),x})}function Bl(i,t,e,n,s,r){let o=null;if(i.length>0){o=new Path2D;const a=t==0?Hl:Nu;let l=e;for(let f=0;f<i.length;f++){let u=i[f];if(u[1]>u[0]){let p=u[0]-l;p>0&&a(o,l,n,p,n+r),l=u[1]}}let c=e+s-l,h=10;c>0&&a(o,l,n-h/2,c,n+r+h)}return o}function Y0(i,t,e){let n=i[i.length-1];n&&n[0]==t?n[1]=e:i.push([t,e])}function Uu(i,t,e,n,s,r,o){let a=[],l=i.length;for(let c=s==1?e:n;c>=e&&c<=n;c+=s)if(t[c]===null){let f=c,u=c;if(s==1)for(;++c<=n&&t[c]===null;)u=c;else for(;--c>=e&&t[c]===null;)u=c;let p=r(i[f]),_=u==f?p:r(i[u]),b=f-s;p=o<=0&&b>=0&&b<l?r(i[b]):p;let d=u+s;_=o>=0&&d>=0&&d<l?r(i[d]):_,_>=p&&a.push([p,_])}return a}function cd(i){return i==0?gm:i==1?on:t=>Zs(t,i)}function Vm(i){let t=i==0?zl:Vl,e=i==0?(s,r,o,a,l,c)=>{s.arcTo(r,o,a,l,c)}:(s,r,o,a,l,c)=>{s.arcTo(o,r,l,a,c)},n=i==0?(s,r,o,a,l)=>{s.rect(r,o,a,l)}:(s,r,o,a,l)=>{s.rect(o,r,l,a)};return(s,r,o,a,l,c=0,h=0)=>{c==0&&h==0?n(s,r,o,a,l):(c=wi(c,a/2,l/2),h=wi(h,a/2,l/2),t(s,r+c,o),e(s,r+a,o,r+a,o+l,c),e(s,r+a,o+l,r,o+l,h),e(s,r,o+l,r,o,h),e(s,r,o,r+a,o,c),s.closePath())}}const zl=(i,t,e)=>{i.moveTo(t,e)},Vl=(i,t,e)=>{i.moveTo(e,t)},wo=(i,t,e)=>{i.lineTo(t,e)},Eo=(i,t,e)=>{i.lineTo(e,t)},Hl=Vm(0),Nu=Vm(1),Hm=(i,t,e,n,s,r)=>{i.arc(t,e,n,s,r)},Gm=(i,t,e,n,s,r)=>{i.arc(e,t,n,s,r)},Wm=(i,t,e,n,s,r,o)=>{i.bezierCurveTo(t,e,n,s,r,o)},Xm=(i,t,e,n,s,r,o)=>{i.bezierCurveTo(e,t,s,n,o,r)};function Ym(i){return(t,e,n,s,r)=>gr(t,e,(o,a,l,c,h,f,u,p,_,b,m)=>{let{pxRound:d,points:M}=o,w,v;c.ori==0?(w=zl,v=Hm):(w=Vl,v=Gm);const U=Ie(M.width*xe,3);let P=(M.size-M.width)/2*xe,L=Ie(P*2,3),F=new Path2D,S=new Path2D,{left:x,top:A,width:V,height:N}=t.bbox;Hl(S,x-L,A-L,V+L*2,N+L*2);const Y=X=>{if(l[X]!=null){let J=d(f(a[X],c,b,p)),K=d(u(l[X],h,m,_));w(F,J+P,K),v(F,J,K,P,0,tl*2)}};if(r)r.forEach(Y);else for(let X=n;X<=s;X++)Y(X);return{stroke:U>0?F:null,fill:F,clip:S,flags:po|yh}})}function qm(i){return(t,e,n,s,r,o)=>{n!=s&&(r!=n&&o!=n&&i(t,e,n),r!=s&&o!=s&&i(t,e,s),i(t,e,o))}}const q0=qm(wo),j0=qm(Eo);function jm(i){const t=ge(i?.alignGaps,0);return(e,n,s,r)=>gr(e,n,(o,a,l,c,h,f,u,p,_,b,m)=>{[s,r]=Ul(l,s,r);let d=o.pxRound,M=N=>d(f(N,c,b,p)),w=N=>d(u(N,h,m,_)),v,U;c.ori==0?(v=wo,U=q0):(v=Eo,U=j0);const P=c.dir*(c.ori==0?1:-1),L={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:po},F=L.stroke;let S=!1;if(r-s>=b*4){let N=pt=>e.posToVal(pt,c.key,!0),Y=null,X=null,J,K,et,ct=M(a[P==1?s:r]),ht=M(a[s]),_t=M(a[r]),vt=N(P==1?ht+1:_t-1);for(let pt=P==1?s:r;pt>=s&&pt<=r;pt+=P){let st=a[pt],bt=(P==1?st<vt:st>vt)?ct:M(st),at=l[pt];bt==ct?at!=null?(K=at,Y==null?(v(F,bt,w(K)),J=Y=X=K):K<Y?Y=K:K>X&&(X=K)):at===null&&(S=!0):(Y!=null&&U(F,ct,w(Y),w(X),w(J),w(K)),at!=null?(K=at,v(F,bt,w(K)),Y=X=J=K):(Y=X=null,at===null&&(S=!0)),ct=bt,vt=N(ct+P))}Y!=null&&Y!=X&&et!=ct&&U(F,ct,w(Y),w(X),w(J),w(K))}else for(let N=P==1?s:r;N>=s&&N<=r;N+=P){let Y=l[N];Y===null?S=!0:Y!=null&&v(F,M(a[N]),w(Y))}let[A,V]=Du(e,n);if(o.fill!=null||A!=0){let N=L.fill=new Path2D(F),Y=o.fillTo(e,n,o.min,o.max,A),X=w(Y),J=M(a[s]),K=M(a[r]);P==-1&&([K,J]=[J,K]),v(N,K,X),v(N,J,X)}if(!o.spanGaps){let N=[];S&&N.push(...Uu(a,l,s,r,P,M,t)),L.gaps=N=o.gaps(e,n,s,r,N),L.clip=Bl(N,c.ori,p,_,b,m)}return V!=0&&(L.band=V==2?[ds(e,n,s,r,F,-1),ds(e,n,s,r,F,1)]:ds(e,n,s,r,F,V)),L})}function $0(i){const t=ge(i.align,1),e=ge(i.ascDesc,!1),n=ge(i.alignGaps,0),s=ge(i.extend,!1);return(r,o,a,l)=>gr(r,o,(c,h,f,u,p,_,b,m,d,M,w)=>{[a,l]=Ul(f,a,l);let v=c.pxRound,{left:U,width:P}=r.bbox,L=ht=>v(_(ht,u,M,m)),F=ht=>v(b(ht,p,w,d)),S=u.ori==0?wo:Eo;const x={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:po},A=x.stroke,V=u.dir*(u.ori==0?1:-1);let N=F(f[V==1?a:l]),Y=L(h[V==1?a:l]),X=Y,J=Y;s&&t==-1&&(J=U,S(A,J,N)),S(A,Y,N);for(let ht=V==1?a:l;ht>=a&&ht<=l;ht+=V){let _t=f[ht];if(_t==null)continue;let vt=L(h[ht]),pt=F(_t);t==1?S(A,vt,N):S(A,X,pt),S(A,vt,pt),N=pt,X=vt}let K=X;s&&t==1&&(K=U+P,S(A,K,N));let[et,ct]=Du(r,o);if(c.fill!=null||et!=0){let ht=x.fill=new Path2D(A),_t=c.fillTo(r,o,c.min,c.max,et),vt=F(_t);S(ht,K,vt),S(ht,J,vt)}if(!c.spanGaps){let ht=[];ht.push(...Uu(h,f,a,l,V,L,n));let _t=c.width*xe/2,vt=e||t==1?_t:-_t,pt=e||t==-1?-_t:_t;ht.forEach(st=>{st[0]+=vt,st[1]+=pt}),x.gaps=ht=c.gaps(r,o,a,l,ht),x.clip=Bl(ht,u.ori,m,d,M,w)}return ct!=0&&(x.band=ct==2?[ds(r,o,a,l,A,-1),ds(r,o,a,l,A,1)]:ds(r,o,a,l,A,ct)),x})}function hd(i,t,e,n,s,r,o=Le){if(i.length>1){let a=null;for(let l=0,c=1/0;l<i.length;l++)if(t[l]!==void 0){if(a!=null){let h=an(i[l]-i[a]);h<c&&(c=h,o=an(e(i[l],n,s,r)-e(i[a],n,s,r)))}a=l}}return o}function Z0(i){i=i||Jo;const t=ge(i.size,[.6,Le,1]),e=i.align||0,n=i.gap||0;let s=i.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;const r=ae(s),o=1-t[0],a=ge(t[1],Le),l=ge(t[2],1),c=ge(i.disp,Jo),h=ge(i.each,p=>{}),{fill:f,stroke:u}=c;return(p,_,b,m)=>gr(p,_,(d,M,w,v,U,P,L,F,S,x,A)=>{let V=d.pxRound,N=e,Y=n*xe,X=a*xe,J=l*xe,K,et;v.ori==0?[K,et]=r(p,_):[et,K]=r(p,_);const ct=v.dir*(v.ori==0?1:-1);let ht=v.ori==0?Hl:Nu,_t=v.ori==0?h:(W,nt,St,xt,Tt,Zt,dt)=>{h(W,nt,St,Tt,xt,dt,Zt)},vt=ge(p.bands,Pu).find(W=>W.series[0]==_),pt=vt!=null?vt.dir:0,st=d.fillTo(p,_,d.min,d.max,pt),lt=V(L(st,U,A,S)),bt,at,zt,Ht=x,Ut=V(d.width*xe),ce=!1,Kt=null,he=null,H=null,nn=null;f!=null&&(Ut==0||u!=null)&&(ce=!0,Kt=f.values(p,_,b,m),he=new Map,new Set(Kt).forEach(W=>{W!=null&&he.set(W,new Path2D)}),Ut>0&&(H=u.values(p,_,b,m),nn=new Map,new Set(H).forEach(W=>{W!=null&&nn.set(W,new Path2D)})));let{x0:Qt,size:ee}=c;if(Qt!=null&&ee!=null){N=1,M=Qt.values(p,_,b,m),Qt.unit==2&&(M=M.map(St=>p.posToVal(F+St*x,v.key,!0)));let W=ee.values(p,_,b,m);ee.unit==2?at=W[0]*x:at=P(W[0],v,x,F)-P(0,v,x,F),Ht=hd(M,w,P,v,x,F,Ht),zt=Ht-at+Y}else Ht=hd(M,w,P,v,x,F,Ht),zt=Ht*o+Y,at=Ht-zt;zt<1&&(zt=0),Ut>=at/2&&(Ut=0),zt<5&&(V=gm);let Gt=zt>0,de=Ht-zt-(Gt?Ut:0);at=V(vh(de,J,X)),bt=(N==0?at/2:N==ct?0:at)-N*ct*((N==0?Y/2:0)+(Gt?Ut/2:0));const Lt={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},C=ce?null:new Path2D;let E=null;if(vt!=null)E=p.data[vt.series[1]];else{let{y0:W,y1:nt}=c;W!=null&&nt!=null&&(w=nt.values(p,_,b,m),E=W.values(p,_,b,m))}let Z=K*at,Q=et*at;for(let W=ct==1?b:m;W>=b&&W<=m;W+=ct){let nt=w[W];if(nt==null)continue;if(E!=null){let kt=E[W]??0;if(nt-kt==0)continue;lt=L(kt,U,A,S)}let St=v.distr!=2||c!=null?M[W]:W,xt=P(St,v,x,F),Tt=L(ge(nt,st),U,A,S),Zt=V(xt-bt),dt=V(Bn(Tt,lt)),Mt=V(wi(Tt,lt)),Nt=dt-Mt;if(nt!=null){let kt=nt<0?Q:Z,Et=nt<0?Z:Q;ce?(Ut>0&&H[W]!=null&&ht(nn.get(H[W]),Zt,Mt+Qn(Ut/2),at,Bn(0,Nt-Ut),kt,Et),Kt[W]!=null&&ht(he.get(Kt[W]),Zt,Mt+Qn(Ut/2),at,Bn(0,Nt-Ut),kt,Et)):ht(C,Zt,Mt+Qn(Ut/2),at,Bn(0,Nt-Ut),kt,Et),_t(p,_,W,Zt-Ut/2,Mt,at+Ut,Nt)}}return Ut>0?Lt.stroke=ce?nn:C:ce||(Lt._fill=d.width==0?d._fill:d._stroke??d._fill,Lt.width=0),Lt.fill=ce?he:C,Lt})}function K0(i,t){const e=ge(t?.alignGaps,0);return(n,s,r,o)=>gr(n,s,(a,l,c,h,f,u,p,_,b,m,d)=>{[r,o]=Ul(c,r,o);let M=a.pxRound,w=K=>M(u(K,h,m,_)),v=K=>M(p(K,f,d,b)),U,P,L;h.ori==0?(U=zl,L=wo,P=Wm):(U=Vl,L=Eo,P=Xm);const F=h.dir*(h.ori==0?1:-1);let S=w(l[F==1?r:o]),x=S,A=[],V=[];for(let K=F==1?r:o;K>=r&&K<=o;K+=F)if(c[K]!=null){let ct=l[K],ht=w(ct);A.push(x=ht),V.push(v(c[K]))}const N={stroke:i(A,V,U,L,P,M),fill:null,clip:null,band:null,gaps:null,flags:po},Y=N.stroke;let[X,J]=Du(n,s);if(a.fill!=null||X!=0){let K=N.fill=new Path2D(Y),et=a.fillTo(n,s,a.min,a.max,X),ct=v(et);L(K,x,ct),L(K,S,ct)}if(!a.spanGaps){let K=[];K.push(...Uu(l,c,r,o,F,w,e)),N.gaps=K=a.gaps(n,s,r,o,K),N.clip=Bl(K,h.ori,_,b,m,d)}return J!=0&&(N.band=J==2?[ds(n,s,r,o,Y,-1),ds(n,s,r,o,Y,1)]:ds(n,s,r,o,Y,J)),N})}function J0(i){return K0(Q0,i)}function Q0(i,t,e,n,s,r){const o=i.length;if(o<2)return null;const a=new Path2D;if(e(a,i[0],t[0]),o==2)n(a,i[1],t[1]);else{let l=Array(o),c=Array(o-1),h=Array(o-1),f=Array(o-1);for(let u=0;u<o-1;u++)h[u]=t[u+1]-t[u],f[u]=i[u+1]-i[u],c[u]=h[u]/f[u];l[0]=c[0];for(let u=1;u<o-1;u++)c[u]===0||c[u-1]===0||c[u-1]>0!=c[u]>0?l[u]=0:(l[u]=3*(f[u-1]+f[u])/((2*f[u]+f[u-1])/c[u-1]+(f[u]+2*f[u-1])/c[u]),isFinite(l[u])||(l[u]=0));l[o-1]=c[o-2];for(let u=0;u<o-1;u++)s(a,i[u]+f[u]/3,t[u]+l[u]*f[u]/3,i[u+1]-f[u]/3,t[u+1]-l[u+1]*f[u]/3,i[u+1],t[u+1])}return a}const Sh=new Set;function ud(){for(let i of Sh)i.syncRect(!0)}So&&(ur(Fb,io,ud),ur(Db,io,ud,!0),ur(xl,io,()=>{cn.pxRatio=xe}));const tv=jm(),ev=Ym();function fd(i,t,e,n){return(n?[i[0],i[1]].concat(i.slice(2)):[i[0]].concat(i.slice(1))).map((r,o)=>wh(r,o,t,e))}function nv(i,t){return i.map((e,n)=>n==0?{}:Qe({},t,e))}function wh(i,t,e,n){return Qe({},t==0?e:n,i)}function $m(i,t,e){return t==null?uo:[t,e]}const iv=$m;function sv(i,t,e){return t==null?uo:Ml(t,e,Au,!0)}function Zm(i,t,e,n){return t==null?uo:Nl(t,e,i.scales[n].log,!1)}const rv=Zm;function Km(i,t,e,n){return t==null?uo:Tu(t,e,i.scales[n].log,!1)}const ov=Km;function av(i,t,e,n,s){let r=Bn(Wf(i),Wf(t)),o=t-i,a=yi(s/n*o,e);do{let l=e[a],c=n*l/o;if(c>=s&&r+(l<5?Fs.get(l):0)<=17)return[l,c]}while(++a<e.length);return[0,0]}function dd(i){let t,e;return i=i.replace(/(\d+)px/,(n,s)=>(t=on((e=+s)*xe))+"px"),[i,t,e]}function lv(i){i.show&&[i.font,i.labelFont].forEach(t=>{let e=Ie(t[2]*xe,1);t[0]=t[0].replace(/[0-9.]+px/,e+"px"),t[1]=e})}function cn(i,t,e){const n={mode:ge(i.mode,1)},s=n.mode;function r(g,y,R,I){let k=y.valToPct(g);return I+R*(y.dir==-1?1-k:k)}function o(g,y,R,I){let k=y.valToPct(g);return I+R*(y.dir==-1?k:1-k)}function a(g,y,R,I){return y.ori==0?r(g,y,R,I):o(g,y,R,I)}n.valToPosH=r,n.valToPosV=o;let l=!1;n.status=0;const c=n.root=ai(mb);if(i.id!=null&&(c.id=i.id),Kn(c,i.class),i.title){let g=ai(bb,c);g.textContent=i.title}const h=xi("canvas"),f=n.ctx=h.getContext("2d"),u=ai(vb,c);ur("click",u,g=>{g.target===_&&(Ue!=Ar||Ve!=Rr)&&yn.click(n,g)},!0);const p=n.under=ai(xb,u);u.appendChild(h);const _=n.over=ai(Mb,u);i=fo(i);const b=+ge(i.pxAlign,1),m=cd(b);(i.plugins||[]).forEach(g=>{g.opts&&(i=g.opts(n,i)||i)});const d=i.ms||.001,M=n.series=s==1?fd(i.series||[],nd,ad,!1):nv(i.series||[null],od),w=n.axes=fd(i.axes||[],ed,sd,!0),v=n.scales={},U=n.bands=i.bands||[];U.forEach(g=>{g.fill=ae(g.fill||null),g.dir=ge(g.dir,-1)});const P=s==2?M[1].facets[0].scale:M[0].scale,L={axes:Q_,series:ei},F=(i.drawOrder||["axes","series"]).map(g=>L[g]);function S(g){const y=g.distr==3?R=>fs(R>0?R:g.clamp(n,R,g.min,g.max,g.key)):g.distr==4?R=>gc(R,g.asinh):g.distr==100?R=>g.fwd(R):R=>R;return R=>{let I=y(R),{_min:k,_max:$}=g,rt=$-k;return(I-k)/rt}}function x(g){let y=v[g];if(y==null){let R=(i.scales||Jo)[g]||Jo;if(R.from!=null){x(R.from);let I=Qe({},v[R.from],R,{key:g});I.valToPct=S(I),v[g]=I}else{y=v[g]=Qe({},g==P?Bm:W0,R),y.key=g;let I=y.time,k=y.range,$=Cs(k);if((g!=P||s==2&&!I)&&($&&(k[0]==null||k[1]==null)&&(k={min:k[0]==null?Vf:{mode:1,hard:k[0],soft:k[0]},max:k[1]==null?Vf:{mode:1,hard:k[1],soft:k[1]}},$=!1),!$&&kl(k))){let rt=k;k=(ut,mt,Pt)=>mt==null?uo:Ml(mt,Pt,rt)}y.range=ae(k||(I?iv:g==P?y.distr==3?rv:y.distr==4?ov:$m:y.distr==3?Zm:y.distr==4?Km:sv)),y.auto=ae($?!1:y.auto),y.clamp=ae(y.clamp||G0),y._min=y._max=null,y.valToPct=S(y)}}}x("x"),x("y"),s==1&&M.forEach(g=>{x(g.scale)}),w.forEach(g=>{x(g.scale)});for(let g in i.scales)x(g);const A=v[P],V=A.distr;let N,Y;A.ori==0?(Kn(c,_b),N=r,Y=o):(Kn(c,gb),N=o,Y=r);const X={};for(let g in v){let y=v[g];(y.min!=null||y.max!=null)&&(X[g]={min:y.min,max:y.max},y.min=y.max=null)}const J=i.tzDate||(g=>new Date(on(g/d))),K=i.fmtDate||Cu,et=d==1?_0(J):v0(J),ct=Jf(J,Kf(d==1?m0:b0,K)),ht=td(J,Qf(M0,K)),_t=[],vt=n.legend=Qe({},w0,i.legend),pt=n.cursor=Qe({},C0,{drag:{y:s==2}},i.cursor),st=vt.show,lt=pt.show,bt=vt.markers;vt.idxs=_t,bt.width=ae(bt.width),bt.dash=ae(bt.dash),bt.stroke=ae(bt.stroke),bt.fill=ae(bt.fill);let at,zt,Ht,Ut=[],ce=[],Kt,he=!1,H={};if(vt.live){const g=M[1]?M[1].values:null;he=g!=null,Kt=he?g(n,1,0):{_:0};for(let y in Kt)H[y]=wu}if(st)if(at=xi("table",Ab,c),Ht=xi("tbody",null,at),vt.mount(n,at),he){zt=xi("thead",null,at,Ht);let g=xi("tr",null,zt);xi("th",null,g);for(var nn in Kt)xi("th",Rf,g).textContent=nn}else Kn(at,Pb),vt.live&&Kn(at,Rb);const Qt={show:!0},ee={show:!1};function Gt(g,y){if(y==0&&(he||!vt.live||s==2))return uo;let R=[],I=xi("tr",Cb,Ht,Ht.childNodes[y]);Kn(I,g.class),g.show||Kn(I,rr);let k=xi("th",null,I);if(bt.show){let ut=ai(Lb,k);if(y>0){let mt=bt.width(n,y);mt&&(ut.style.border=mt+"px "+bt.dash(n,y)+" "+bt.stroke(n,y)),ut.style.background=bt.fill(n,y)}}let $=ai(Rf,k);g.label instanceof HTMLElement?$.appendChild(g.label):$.textContent=g.label,y>0&&(bt.show||($.style.color=g.width>0?bt.stroke(n,y):bt.fill(n,y)),Lt("click",k,ut=>{if(pt._lock)return;sn(ut);let mt=M.indexOf(g);if((ut.ctrlKey||ut.metaKey)!=vt.isolate){let Pt=M.some((Ct,It)=>It>0&&It!=mt&&Ct.show);M.forEach((Ct,It)=>{It>0&&Li(It,Pt?It==mt?Qt:ee:Qt,!0,Ze.setSeries)})}else Li(mt,{show:!g.show},!0,Ze.setSeries)},!1),Gi&&Lt(If,k,ut=>{pt._lock||(sn(ut),Li(M.indexOf(g),Cr,!0,Ze.setSeries))},!1));for(var rt in Kt){let ut=xi("td",Ib,I);ut.textContent="--",R.push(ut)}return[I,R]}const de=new Map;function Lt(g,y,R,I=!0){const k=de.get(y)||{},$=pt.bind[g](n,y,R,I);$&&(ur(g,y,k[g]=$),de.set(y,k))}function C(g,y,R){const I=de.get(y)||{};for(let k in I)(g==null||k==g)&&(bh(k,y,I[k]),delete I[k]);g==null&&de.delete(y)}let E=0,Z=0,Q=0,W=0,nt=0,St=0,xt=nt,Tt=St,Zt=Q,dt=W,Mt=0,Nt=0,kt=0,Et=0;n.bbox={};let ie=!1,qt=!1,pe=!1,z=!1,yt=!1,it=!1;function ot(g,y,R){(R||g!=n.width||y!=n.height)&&At(g,y),Sr(!1),pe=!0,qt=!0,wr()}function At(g,y){n.width=E=Q=g,n.height=Z=W=y,nt=St=0,dn(),be();let R=n.bbox;Mt=R.left=Zs(nt*xe,.5),Nt=R.top=Zs(St*xe,.5),kt=R.width=Zs(Q*xe,.5),Et=R.height=Zs(W*xe,.5)}const Rt=3;function Jt(){let g=!1,y=0;for(;!g;){y++;let R=K_(y),I=J_(y);g=y==Rt||R&&I,g||(At(n.width,n.height),qt=!0)}}function Be({width:g,height:y}){ot(g,y)}n.setSize=Be;function dn(){let g=!1,y=!1,R=!1,I=!1;w.forEach((k,$)=>{if(k.show&&k._show){let{side:rt,_size:ut}=k,mt=rt%2,Pt=k.label!=null?k.labelSize:0,Ct=ut+Pt;Ct>0&&(mt?(Q-=Ct,rt==3?(nt+=Ct,I=!0):R=!0):(W-=Ct,rt==0?(St+=Ct,g=!0):y=!0))}}),Ri[0]=g,Ri[1]=R,Ri[2]=y,Ri[3]=I,Q-=T[1]+T[3],nt+=T[3],W-=T[2]+T[0],St+=T[0]}function be(){let g=nt+Q,y=St+W,R=nt,I=St;function k($,rt){switch($){case 1:return g+=rt,g-rt;case 2:return y+=rt,y-rt;case 3:return R-=rt,R+rt;case 0:return I-=rt,I+rt}}w.forEach(($,rt)=>{if($.show&&$._show){let ut=$.side;$._pos=k(ut,$._size),$.label!=null&&($._lpos=k(ut,$.labelSize))}})}if(pt.dataIdx==null){let g=pt.hover,y=g.skip=new Set(g.skip??[]);y.add(void 0);let R=g.prox=ae(g.prox),I=g.bias??=0;pt.dataIdx=(k,$,rt,ut)=>{if($==0)return rt;let mt=rt,Pt=R(k,$,rt,ut)??Le,Ct=Pt>=0&&Pt<Le,It=A.ori==0?Q:W,jt=pt.left,ve=t[0],_e=t[$];if(y.has(_e[rt])){mt=null;let se=null,Xt=null,Vt;if(I==0||I==-1)for(Vt=rt;se==null&&Vt-- >0;)y.has(_e[Vt])||(se=Vt);if(I==0||I==1)for(Vt=rt;Xt==null&&Vt++<_e.length;)y.has(_e[Vt])||(Xt=Vt);if(se!=null||Xt!=null)if(Ct){let Oe=se==null?-1/0:N(ve[se],A,It,0),Ge=Xt==null?1/0:N(ve[Xt],A,It,0),bn=jt-Oe,Ee=Ge-jt;bn<=Ee?bn<=Pt&&(mt=se):Ee<=Pt&&(mt=Xt)}else mt=Xt==null?se:se==null?Xt:rt-se<=Xt-rt?se:Xt}else Ct&&an(jt-N(ve[rt],A,It,0))>Pt&&(mt=null);return mt}}const sn=g=>{pt.event=g};pt.idxs=_t,pt._lock=!1;let De=pt.points;De.show=ae(De.show),De.size=ae(De.size),De.stroke=ae(De.stroke),De.width=ae(De.width),De.fill=ae(De.fill);const Xn=n.focus=Qe({},i.focus||{alpha:.3},pt.focus),Gi=Xn.prox>=0,Vn=Gi&&De.one;let Sn=[],Wi=[],Xi=[];function ks(g,y){let R=De.show(n,y);if(R instanceof HTMLElement)return Kn(R,Tb),Kn(R,g.class),Ui(R,-10,-10,Q,W),_.insertBefore(R,Sn[y]),R}function Po(g,y){if(s==1||y>0){let R=s==1&&v[g.scale].time,I=g.value;g.value=R?qf(I)?td(J,Qf(I,K)):I||ht:I||z0,g.label=g.label||(R?I0:L0)}if(Vn||y>0){g.width=g.width==null?1:g.width,g.paths=g.paths||tv||Wb,g.fillTo=ae(g.fillTo||X0),g.pxAlign=+ge(g.pxAlign,b),g.pxRound=cd(g.pxAlign),g.stroke=ae(g.stroke||null),g.fill=ae(g.fill||null),g._stroke=g._fill=g._paths=g._focus=null;let R=V0(Bn(1,g.width),1),I=g.points=Qe({},{size:R,width:Bn(1,R*.2),stroke:g.stroke,space:R*2,paths:ev,_stroke:null,_fill:null},g.points);I.show=ae(I.show),I.filter=ae(I.filter),I.fill=ae(I.fill),I.stroke=ae(I.stroke),I.paths=ae(I.paths),I.pxAlign=g.pxAlign}if(st){let R=Gt(g,y);Ut.splice(y,0,R[0]),ce.splice(y,0,R[1]),vt.values.push(null)}if(lt){_t.splice(y,0,null);let R=null;Vn?y==0&&(R=ks(g,y)):y>0&&(R=ks(g,y)),Sn.splice(y,0,R),Wi.splice(y,0,0),Xi.splice(y,0,0)}gn("addSeries",y)}function Mr(g,y){y=y??M.length,g=s==1?wh(g,y,nd,ad):wh(g,y,{},od),M.splice(y,0,g),Po(M[y],y)}n.addSeries=Mr;function ha(g){if(M.splice(g,1),st){vt.values.splice(g,1),ce.splice(g,1);let y=Ut.splice(g,1)[0];C(null,y.firstChild),y.remove()}lt&&(_t.splice(g,1),Sn.splice(g,1)[0].remove(),Wi.splice(g,1),Xi.splice(g,1)),gn("delSeries",g)}n.delSeries=ha;const Ri=[!1,!1,!1,!1];function Jl(g,y){if(g._show=g.show,g.show){let R=g.side%2,I=v[g.scale];I==null&&(g.scale=R?M[1].scale:P,I=v[g.scale]);let k=I.time;g.size=ae(g.size),g.space=ae(g.space),g.rotate=ae(g.rotate),Cs(g.incrs)&&g.incrs.forEach(rt=>{!Fs.has(rt)&&Fs.set(rt,xm(rt))}),g.incrs=ae(g.incrs||(I.distr==2?f0:k?d==1?p0:g0:Ks)),g.splits=ae(g.splits||(k&&I.distr==1?et:I.distr==3?xh:I.distr==4?U0:D0)),g.stroke=ae(g.stroke),g.grid.stroke=ae(g.grid.stroke),g.ticks.stroke=ae(g.ticks.stroke),g.border.stroke=ae(g.border.stroke);let $=g.values;g.values=Cs($)&&!Cs($[0])?ae($):k?Cs($)?Jf(J,Kf($,K)):qf($)?x0(J,$):$||ct:$||F0,g.filter=ae(g.filter||(I.distr>=3&&I.log==10?k0:I.distr==3&&I.log==2?B0:bm)),g.font=dd(g.font),g.labelFont=dd(g.labelFont),g._size=g.size(n,null,y,0),g._space=g._rotate=g._incrs=g._found=g._splits=g._values=null,g._size>0&&(Ri[y]=!0,g._el=ai(yb,u))}}function Bs(g,y,R,I){let[k,$,rt,ut]=R,mt=y%2,Pt=0;return mt==0&&(ut||$)&&(Pt=y==0&&!k||y==2&&!rt?on(ed.size/3):0),mt==1&&(k||rt)&&(Pt=y==1&&!$||y==3&&!ut?on(sd.size/2):0),Pt}const ua=n.padding=(i.padding||[Bs,Bs,Bs,Bs]).map(g=>ae(ge(g,Bs))),T=n._padding=ua.map((g,y)=>g(n,y,Ri,0));let B,q=null,j=null;const G=s==1?M[0].idxs:null;let ft=null,wt=!1;function Ot(g,y){if(t=g??[],n.data=n._data=t,s==2){B=0;for(let R=1;R<M.length;R++)B+=t[R][0].length}else{t.length==0&&(n.data=n._data=t=[[]]),ft=t[0],B=ft.length;let R=t;if(V==2){R=t.slice();let I=R[0]=Array(B);for(let k=0;k<B;k++)I[k]=k}n._data=t=R}if(Sr(!0),gn("setData"),V==2&&(pe=!0),y!==!1){let R=A;R.auto(n,wt)?Ft():xs(P,R.min,R.max),z=z||pt.left>=0,it=!0,wr()}}n.setData=Ot;function Ft(){wt=!0;let g,y;s==1&&(B>0?(q=G[0]=0,j=G[1]=B-1,g=t[0][q],y=t[0][j],V==2?(g=q,y=j):g==y&&(V==3?[g,y]=Nl(g,g,A.log,!1):V==4?[g,y]=Tu(g,g,A.log,!1):A.time?y=g+on(86400/d):[g,y]=Ml(g,y,Au,!0))):(q=G[0]=g=null,j=G[1]=y=null)),xs(P,g,y)}let Wt,Yt,Dt,oe,Me,Se,pn,ue,Bt,ze;function me(g,y,R,I,k,$){g??=Cf,R??=Pu,I??="butt",k??=Cf,$??="round",g!=Wt&&(f.strokeStyle=Wt=g),k!=Yt&&(f.fillStyle=Yt=k),y!=Dt&&(f.lineWidth=Dt=y),$!=Me&&(f.lineJoin=Me=$),I!=Se&&(f.lineCap=Se=I),R!=oe&&f.setLineDash(oe=R)}function Hn(g,y,R,I){y!=Yt&&(f.fillStyle=Yt=y),g!=pn&&(f.font=pn=g),R!=ue&&(f.textAlign=ue=R),I!=Bt&&(f.textBaseline=Bt=I)}function Pi(g,y,R,I,k=0){if(I.length>0&&g.auto(n,wt)&&(y==null||y.min==null)){let $=ge(q,0),rt=ge(j,I.length-1),ut=R.min==null?kb(I,$,rt,k,g.distr==3):[R.min,R.max];g.min=wi(g.min,R.min=ut[0]),g.max=Bn(g.max,R.max=ut[1])}}const wn={min:null,max:null};function zs(){for(let I in v){let k=v[I];X[I]==null&&(k.min==null||X[P]!=null&&k.auto(n,wt))&&(X[I]=wn)}for(let I in v){let k=v[I];X[I]==null&&k.from!=null&&X[k.from]!=null&&(X[I]=wn)}X[P]!=null&&Sr(!0);let g={};for(let I in X){let k=X[I];if(k!=null){let $=g[I]=fo(v[I],qb);if(k.min!=null)Qe($,k);else if(I!=P||s==2)if(B==0&&$.from==null){let rt=$.range(n,null,null,I);$.min=rt[0],$.max=rt[1]}else $.min=Le,$.max=-Le}}if(B>0){M.forEach((I,k)=>{if(s==1){let $=I.scale,rt=X[$];if(rt==null)return;let ut=g[$];if(k==0){let mt=ut.range(n,ut.min,ut.max,$);ut.min=mt[0],ut.max=mt[1],q=yi(ut.min,t[0]),j=yi(ut.max,t[0]),j-q>1&&(t[0][q]<ut.min&&q++,t[0][j]>ut.max&&j--),I.min=ft[q],I.max=ft[j]}else I.show&&I.auto&&Pi(ut,rt,I,t[k],I.sorted);I.idxs[0]=q,I.idxs[1]=j}else if(k>0&&I.show&&I.auto){let[$,rt]=I.facets,ut=$.scale,mt=rt.scale,[Pt,Ct]=t[k],It=g[ut],jt=g[mt];It!=null&&Pi(It,X[ut],$,Pt,$.sorted),jt!=null&&Pi(jt,X[mt],rt,Ct,rt.sorted),I.min=rt.min,I.max=rt.max}});for(let I in g){let k=g[I],$=X[I];if(k.from==null&&($==null||$.min==null)){let rt=k.range(n,k.min==Le?null:k.min,k.max==-Le?null:k.max,I);k.min=rt[0],k.max=rt[1]}}}for(let I in g){let k=g[I];if(k.from!=null){let $=g[k.from];if($.min==null)k.min=k.max=null;else{let rt=k.range(n,$.min,$.max,I);k.min=rt[0],k.max=rt[1]}}}let y={},R=!1;for(let I in g){let k=g[I],$=v[I];if($.min!=k.min||$.max!=k.max){$.min=k.min,$.max=k.max;let rt=$.distr;$._min=rt==3?fs($.min):rt==4?gc($.min,$.asinh):rt==100?$.fwd($.min):$.min,$._max=rt==3?fs($.max):rt==4?gc($.max,$.asinh):rt==100?$.fwd($.max):$.max,y[I]=R=!0}}if(R){M.forEach((I,k)=>{s==2?k>0&&y.y&&(I._paths=null):y[I.scale]&&(I._paths=null)});for(let I in y)pe=!0,gn("setScale",I);lt&&pt.left>=0&&(z=it=!0)}for(let I in X)X[I]=null}function Ce(g){let y=vh(q-1,0,B-1),R=vh(j+1,0,B-1);for(;g[y]==null&&y>0;)y--;for(;g[R]==null&&R<B-1;)R++;return[y,R]}function ei(){if(B>0){let g=M.some(y=>y._focus)&&ze!=Xn.alpha;g&&(f.globalAlpha=ze=Xn.alpha),M.forEach((y,R)=>{if(R>0&&y.show&&(bs(R,!1),bs(R,!0),y._paths==null)){let I=ze;ze!=y.alpha&&(f.globalAlpha=ze=y.alpha);let k=s==2?[0,t[R][0].length-1]:Ce(t[R]);y._paths=y.paths(n,R,k[0],k[1]),ze!=I&&(f.globalAlpha=ze=I)}}),M.forEach((y,R)=>{if(R>0&&y.show){let I=ze;ze!=y.alpha&&(f.globalAlpha=ze=y.alpha),y._paths!=null&&In(R,!1);{let k=y._paths!=null?y._paths.gaps:null,$=y.points.show(n,R,q,j,k),rt=y.points.filter(n,R,$,k);($||rt)&&(y.points._paths=y.points.paths(n,R,q,j,rt),In(R,!0))}ze!=I&&(f.globalAlpha=ze=I),gn("drawSeries",R)}}),g&&(f.globalAlpha=ze=1)}}function bs(g,y){let R=y?M[g].points:M[g];R._stroke=R.stroke(n,g),R._fill=R.fill(n,g)}function In(g,y){let R=y?M[g].points:M[g],{stroke:I,fill:k,clip:$,flags:rt,_stroke:ut=R._stroke,_fill:mt=R._fill,_width:Pt=R.width}=R._paths;Pt=Ie(Pt*xe,3);let Ct=null,It=Pt%2/2;y&&mt==null&&(mt=Pt>0?"#fff":ut);let jt=R.pxAlign==1&&It>0;if(jt&&f.translate(It,It),!y){let ve=Mt-Pt/2,_e=Nt-Pt/2,se=kt+Pt,Xt=Et+Pt;Ct=new Path2D,Ct.rect(ve,_e,se,Xt)}y?yr(ut,Pt,R.dash,R.cap,mt,I,k,rt,$):Ci(g,ut,Pt,R.dash,R.cap,mt,I,k,rt,Ct,$),jt&&f.translate(-It,-It)}function Ci(g,y,R,I,k,$,rt,ut,mt,Pt,Ct){let It=!1;mt!=0&&U.forEach((jt,ve)=>{if(jt.series[0]==g){let _e=M[jt.series[1]],se=t[jt.series[1]],Xt=(_e._paths||Jo).band;Cs(Xt)&&(Xt=jt.dir==1?Xt[0]:Xt[1]);let Vt,Oe=null;_e.show&&Xt&&zb(se,q,j)?(Oe=jt.fill(n,ve)||$,Vt=_e._paths.clip):Xt=null,yr(y,R,I,k,Oe,rt,ut,mt,Pt,Ct,Vt,Xt),It=!0}}),It||yr(y,R,I,k,$,rt,ut,mt,Pt,Ct)}const di=po|yh;function yr(g,y,R,I,k,$,rt,ut,mt,Pt,Ct,It){me(g,y,R,I,k),(mt||Pt||It)&&(f.save(),mt&&f.clip(mt),Pt&&f.clip(Pt)),It?(ut&di)==di?(f.clip(It),Ct&&f.clip(Ct),da(k,rt),fa(g,$,y)):ut&yh?(da(k,rt),f.clip(It),fa(g,$,y)):ut&po&&(f.save(),f.clip(It),Ct&&f.clip(Ct),da(k,rt),f.restore(),fa(g,$,y)):(da(k,rt),fa(g,$,y)),(mt||Pt||It)&&f.restore()}function fa(g,y,R){R>0&&(y instanceof Map?y.forEach((I,k)=>{f.strokeStyle=Wt=k,f.stroke(I)}):y!=null&&g&&f.stroke(y))}function da(g,y){y instanceof Map?y.forEach((R,I)=>{f.fillStyle=Yt=I,f.fill(R)}):y!=null&&g&&f.fill(y)}function Z_(g,y,R,I){let k=w[g],$;if(I<=0)$=[0,0];else{let rt=k._space=k.space(n,g,y,R,I),ut=k._incrs=k.incrs(n,g,y,R,I,rt);$=av(y,R,ut,I,rt)}return k._found=$}function Ql(g,y,R,I,k,$,rt,ut,mt,Pt){let Ct=rt%2/2;b==1&&f.translate(Ct,Ct),me(ut,rt,mt,Pt,ut),f.beginPath();let It,jt,ve,_e,se=k+(I==0||I==3?-$:$);R==0?(jt=k,_e=se):(It=k,ve=se);for(let Xt=0;Xt<g.length;Xt++)y[Xt]!=null&&(R==0?It=ve=g[Xt]:jt=_e=g[Xt],f.moveTo(It,jt),f.lineTo(ve,_e));f.stroke(),b==1&&f.translate(-Ct,-Ct)}function K_(g){let y=!0;return w.forEach((R,I)=>{if(!R.show)return;let k=v[R.scale];if(k.min==null){R._show&&(y=!1,R._show=!1,Sr(!1));return}else R._show||(y=!1,R._show=!0,Sr(!1));let $=R.side,rt=$%2,{min:ut,max:mt}=k,[Pt,Ct]=Z_(I,ut,mt,rt==0?Q:W);if(Ct==0)return;let It=k.distr==2,jt=R._splits=R.splits(n,I,ut,mt,Pt,Ct,It),ve=k.distr==2?jt.map(Vt=>ft[Vt]):jt,_e=k.distr==2?ft[jt[1]]-ft[jt[0]]:Pt,se=R._values=R.values(n,R.filter(n,ve,I,Ct,_e),I,Ct,_e);R._rotate=$==2?R.rotate(n,se,I,Ct):0;let Xt=R._size;R._size=li(R.size(n,se,I,g)),Xt!=null&&R._size!=Xt&&(y=!1)}),y}function J_(g){let y=!0;return ua.forEach((R,I)=>{let k=R(n,I,Ri,g);k!=T[I]&&(y=!1),T[I]=k}),y}function Q_(){for(let g=0;g<w.length;g++){let y=w[g];if(!y.show||!y._show)continue;let R=y.side,I=R%2,k,$,rt=y.stroke(n,g),ut=R==0||R==3?-1:1,[mt,Pt]=y._found;if(y.label!=null){let Dn=y.labelGap*ut,jn=on((y._lpos+Dn)*xe);Hn(y.labelFont[0],rt,"center",R==2?Uo:Pf),f.save(),I==1?(k=$=0,f.translate(jn,on(Nt+Et/2)),f.rotate((R==3?-tl:tl)/2)):(k=on(Mt+kt/2),$=jn);let Gs=_m(y.label)?y.label(n,g,mt,Pt):y.label;f.fillText(Gs,k,$),f.restore()}if(Pt==0)continue;let Ct=v[y.scale],It=I==0?kt:Et,jt=I==0?Mt:Nt,ve=y._splits,_e=Ct.distr==2?ve.map(Dn=>ft[Dn]):ve,se=Ct.distr==2?ft[ve[1]]-ft[ve[0]]:mt,Xt=y.ticks,Vt=y.border,Oe=Xt.show?Xt.size:0,Ge=on(Oe*xe),bn=on((y.alignTo==2?y._size-Oe-y.gap:y.gap)*xe),Ee=y._rotate*-tl/180,We=m(y._pos*xe),Yn=(Ge+bn)*ut,Fn=We+Yn;$=I==0?Fn:0,k=I==1?Fn:0;let ni=y.font[0],pi=y.align==1?Ir:y.align==2?pc:Ee>0?Ir:Ee<0?pc:I==0?"center":R==3?pc:Ir,Fi=Ee||I==1?"middle":R==2?Uo:Pf;Hn(ni,rt,pi,Fi);let qn=y.font[1]*y.lineGap,ii=ve.map(Dn=>m(a(Dn,Ct,It,jt))),mi=y._values;for(let Dn=0;Dn<mi.length;Dn++){let jn=mi[Dn];if(jn!=null){I==0?k=ii[Dn]:$=ii[Dn],jn=""+jn;let Gs=jn.indexOf(`
`)==-1?[jn]:jn.split(/\n/gm);for(let Un=0;Un<Gs.length;Un++){let Sf=Gs[Un];Ee?(f.save(),f.translate(k,$+Un*qn),f.rotate(Ee),f.fillText(Sf,0,0),f.restore()):f.fillText(Sf,k,$+Un*qn)}}}Xt.show&&Ql(ii,Xt.filter(n,_e,g,Pt,se),I,R,We,Ge,Ie(Xt.width*xe,3),Xt.stroke(n,g),Xt.dash,Xt.cap);let Di=y.grid;Di.show&&Ql(ii,Di.filter(n,_e,g,Pt,se),I,I==0?2:1,I==0?Nt:Mt,I==0?Et:kt,Ie(Di.width*xe,3),Di.stroke(n,g),Di.dash,Di.cap),Vt.show&&Ql([We],[1],I==0?1:0,I==0?1:2,I==1?Nt:Mt,I==1?Et:kt,Ie(Vt.width*xe,3),Vt.stroke(n,g),Vt.dash,Vt.cap)}gn("drawAxes")}function Sr(g){M.forEach((y,R)=>{R>0&&(y._paths=null,g&&(s==1?(y.min=null,y.max=null):y.facets.forEach(I=>{I.min=null,I.max=null})))})}let pa=!1,tc=!1,Co=[];function tg(){tc=!1;for(let g=0;g<Co.length;g++)gn(...Co[g]);Co.length=0}function wr(){pa||(t0(rf),pa=!0)}function eg(g,y=!1){pa=!0,tc=y,g(n),rf(),y&&Co.length>0&&queueMicrotask(tg)}n.batch=eg;function rf(){if(ie&&(zs(),ie=!1),pe&&(Jt(),pe=!1),qt){if(ke(p,Ir,nt),ke(p,Uo,St),ke(p,Yo,Q),ke(p,qo,W),ke(_,Ir,nt),ke(_,Uo,St),ke(_,Yo,Q),ke(_,qo,W),ke(u,Yo,E),ke(u,qo,Z),h.width=on(E*xe),h.height=on(Z*xe),w.forEach(({_el:g,_show:y,_size:R,_pos:I,side:k})=>{if(g!=null)if(y){let $=k===3||k===0?R:0,rt=k%2==1;ke(g,rt?"left":"top",I-$),ke(g,rt?"width":"height",R),ke(g,rt?"top":"left",rt?St:nt),ke(g,rt?"height":"width",rt?W:Q),gh(g,rr)}else Kn(g,rr)}),Wt=Yt=Dt=Me=Se=pn=ue=Bt=oe=null,ze=1,Fo(!0),nt!=xt||St!=Tt||Q!=Zt||W!=dt){Sr(!1);let g=Q/Zt,y=W/dt;if(lt&&!z&&pt.left>=0){pt.left*=g,pt.top*=y,Er&&Ui(Er,on(pt.left),0,Q,W),Tr&&Ui(Tr,0,on(pt.top),Q,W);for(let R=0;R<Sn.length;R++){let I=Sn[R];I!=null&&(Wi[R]*=g,Xi[R]*=y,Ui(I,li(Wi[R]),li(Xi[R]),Q,W))}}if(Ne.show&&!yt&&Ne.left>=0&&Ne.width>0){Ne.left*=g,Ne.width*=g,Ne.top*=y,Ne.height*=y;for(let R in oc)ke(Pr,R,Ne[R])}xt=nt,Tt=St,Zt=Q,dt=W}gn("setSize"),qt=!1}E>0&&Z>0&&(f.clearRect(0,0,h.width,h.height),gn("drawClear"),F.forEach(g=>g()),gn("draw")),Ne.show&&yt&&(ma(Ne),yt=!1),lt&&z&&(Hs(null,!0,!1),z=!1),vt.show&&vt.live&&it&&(sc(),it=!1),l||(l=!0,n.status=1,gn("ready")),wt=!1,pa=!1}n.redraw=(g,y)=>{pe=y||!1,g!==!1?xs(P,A.min,A.max):wr()};function ec(g,y){let R=v[g];if(R.from==null){if(B==0){let I=R.range(n,y.min,y.max,g);y.min=I[0],y.max=I[1]}if(y.min>y.max){let I=y.min;y.min=y.max,y.max=I}if(B>1&&y.min!=null&&y.max!=null&&y.max-y.min<1e-16)return;g==P&&R.distr==2&&B>0&&(y.min=yi(y.min,t[0]),y.max=yi(y.max,t[0]),y.min==y.max&&y.max++),X[g]=y,ie=!0,wr()}}n.setScale=ec;let nc,ic,Er,Tr,of,af,Ar,Rr,lf,cf,Ue,Ve,vs=!1;const yn=pt.drag;let mn=yn.x,_n=yn.y;lt&&(pt.x&&(nc=ai(wb,_)),pt.y&&(ic=ai(Eb,_)),A.ori==0?(Er=nc,Tr=ic):(Er=ic,Tr=nc),Ue=pt.left,Ve=pt.top);const Ne=n.select=Qe({show:!0,over:!0,left:0,width:0,top:0,height:0},i.select),Pr=Ne.show?ai(Sb,Ne.over?_:p):null;function ma(g,y){if(Ne.show){for(let R in g)Ne[R]=g[R],R in oc&&ke(Pr,R,g[R]);y!==!1&&gn("setSelect")}}n.setSelect=ma;function ng(g){if(M[g].show)st&&gh(Ut[g],rr);else if(st&&Kn(Ut[g],rr),lt){let R=Vn?Sn[0]:Sn[g];R!=null&&Ui(R,-10,-10,Q,W)}}function xs(g,y,R){ec(g,{min:y,max:R})}function Li(g,y,R,I){y.focus!=null&&ag(g),y.show!=null&&M.forEach((k,$)=>{$>0&&(g==$||g==null)&&(k.show=y.show,ng($),s==2?(xs(k.facets[0].scale,null,null),xs(k.facets[1].scale,null,null)):xs(k.scale,null,null),wr())}),R!==!1&&gn("setSeries",g,y),I&&Do("setSeries",n,g,y)}n.setSeries=Li;function ig(g,y){Qe(U[g],y)}function sg(g,y){g.fill=ae(g.fill||null),g.dir=ge(g.dir,-1),y=y??U.length,U.splice(y,0,g)}function rg(g){g==null?U.length=0:U.splice(g,1)}n.addBand=sg,n.setBand=ig,n.delBand=rg;function og(g,y){M[g].alpha=y,lt&&Sn[g]!=null&&(Sn[g].style.opacity=y),st&&Ut[g]&&(Ut[g].style.opacity=y)}let Yi,Ms,Vs;const Cr={focus:!0};function ag(g){if(g!=Vs){let y=g==null,R=Xn.alpha!=1;M.forEach((I,k)=>{if(s==1||k>0){let $=y||k==0||k==g;I._focus=y?null:$,R&&og(k,$?1:Xn.alpha)}}),Vs=g,R&&wr()}}st&&Gi&&Lt(Ff,at,g=>{pt._lock||(sn(g),Vs!=null&&Li(null,Cr,!0,Ze.setSeries))});function Ii(g,y,R){let I=v[y];R&&(g=g/xe-(I.ori==1?St:nt));let k=Q;I.ori==1&&(k=W,g=k-g),I.dir==-1&&(g=k-g);let $=I._min,rt=I._max,ut=g/k,mt=$+(rt-$)*ut,Pt=I.distr;return Pt==3?ho(10,mt):Pt==4?Hb(mt,I.asinh):Pt==100?I.bwd(mt):mt}function lg(g,y){let R=Ii(g,P,y);return yi(R,t[0],q,j)}n.valToIdx=g=>yi(g,t[0]),n.posToIdx=lg,n.posToVal=Ii,n.valToPos=(g,y,R)=>v[y].ori==0?r(g,v[y],R?kt:Q,R?Mt:0):o(g,v[y],R?Et:W,R?Nt:0),n.setCursor=(g,y,R)=>{Ue=g.left,Ve=g.top,Hs(null,y,R)};function hf(g,y){ke(Pr,Ir,Ne.left=g),ke(Pr,Yo,Ne.width=y)}function uf(g,y){ke(Pr,Uo,Ne.top=g),ke(Pr,qo,Ne.height=y)}let Lo=A.ori==0?hf:uf,Io=A.ori==1?hf:uf;function cg(){if(st&&vt.live)for(let g=s==2?1:0;g<M.length;g++){if(g==0&&he)continue;let y=vt.values[g],R=0;for(let I in y)ce[g][R++].firstChild.nodeValue=y[I]}}function sc(g,y){if(g!=null&&(g.idxs?g.idxs.forEach((R,I)=>{_t[I]=R}):Yb(g.idx)||_t.fill(g.idx),vt.idx=_t[0]),st&&vt.live){for(let R=0;R<M.length;R++)(R>0||s==1&&!he)&&hg(R,_t[R]);cg()}it=!1,y!==!1&&gn("setLegend")}n.setLegend=sc;function hg(g,y){let R=M[g],I=g==0&&V==2?ft:t[g],k;he?k=R.values(n,g,y)??H:(k=R.value(n,y==null?null:I[y],g,y),k=k==null?H:{_:k}),vt.values[g]=k}function Hs(g,y,R){lf=Ue,cf=Ve,[Ue,Ve]=pt.move(n,Ue,Ve),pt.left=Ue,pt.top=Ve,lt&&(Er&&Ui(Er,on(Ue),0,Q,W),Tr&&Ui(Tr,0,on(Ve),Q,W));let I,k=q>j;Yi=Le,Ms=null;let $=A.ori==0?Q:W,rt=A.ori==1?Q:W;if(Ue<0||B==0||k){I=pt.idx=null;for(let ut=0;ut<M.length;ut++){let mt=Sn[ut];mt!=null&&Ui(mt,-10,-10,Q,W)}Gi&&Li(null,Cr,!0,g==null&&Ze.setSeries),vt.live&&(_t.fill(I),it=!0)}else{let ut,mt,Pt;s==1&&(ut=A.ori==0?Ue:Ve,mt=Ii(ut,P),I=pt.idx=yi(mt,t[0],q,j),Pt=N(t[0][I],A,$,0));let Ct=-10,It=-10,jt=0,ve=0,_e=!0,se="",Xt="";for(let Vt=s==2?1:0;Vt<M.length;Vt++){let Oe=M[Vt],Ge=_t[Vt],bn=Ge==null?null:s==1?t[Vt][Ge]:t[Vt][1][Ge],Ee=pt.dataIdx(n,Vt,I,mt),We=Ee==null?null:s==1?t[Vt][Ee]:t[Vt][1][Ee];if(it=it||We!=bn||Ee!=Ge,_t[Vt]=Ee,Vt>0&&Oe.show){let Yn=Ee==null?-10:Ee==I?Pt:N(s==1?t[0][Ee]:t[Vt][0][Ee],A,$,0),Fn=We==null?-10:Y(We,s==1?v[Oe.scale]:v[Oe.facets[1].scale],rt,0);if(Gi&&We!=null){let ni=A.ori==1?Ue:Ve,pi=an(Xn.dist(n,Vt,Ee,Fn,ni));if(pi<Yi){let Fi=Xn.bias;if(Fi!=0){let qn=Ii(ni,Oe.scale),ii=We>=0?1:-1,mi=qn>=0?1:-1;mi==ii&&(mi==1?Fi==1?We>=qn:We<=qn:Fi==1?We<=qn:We>=qn)&&(Yi=pi,Ms=Vt)}else Yi=pi,Ms=Vt}}if(it||Vn){let ni,pi;A.ori==0?(ni=Yn,pi=Fn):(ni=Fn,pi=Yn);let Fi,qn,ii,mi,Di,Dn,jn=!0,Gs=De.bbox;if(Gs!=null){jn=!1;let Un=Gs(n,Vt);ii=Un.left,mi=Un.top,Fi=Un.width,qn=Un.height}else ii=ni,mi=pi,Fi=qn=De.size(n,Vt);if(Dn=De.fill(n,Vt),Di=De.stroke(n,Vt),Vn)Vt==Ms&&Yi<=Xn.prox&&(Ct=ii,It=mi,jt=Fi,ve=qn,_e=jn,se=Dn,Xt=Di);else{let Un=Sn[Vt];Un!=null&&(Wi[Vt]=ii,Xi[Vt]=mi,zf(Un,Fi,qn,jn),kf(Un,Dn,Di),Ui(Un,li(ii),li(mi),Q,W))}}}}if(Vn){let Vt=Xn.prox,Oe=Vs==null?Yi<=Vt:Yi>Vt||Ms!=Vs;if(it||Oe){let Ge=Sn[0];Ge!=null&&(Wi[0]=Ct,Xi[0]=It,zf(Ge,jt,ve,_e),kf(Ge,se,Xt),Ui(Ge,li(Ct),li(It),Q,W))}}}if(Ne.show&&vs)if(g!=null){let[ut,mt]=Ze.scales,[Pt,Ct]=Ze.match,[It,jt]=g.cursor.sync.scales,ve=g.cursor.drag;if(mn=ve._x,_n=ve._y,mn||_n){let{left:_e,top:se,width:Xt,height:Vt}=g.select,Oe=g.scales[It].ori,Ge=g.posToVal,bn,Ee,We,Yn,Fn,ni=ut!=null&&Pt(ut,It),pi=mt!=null&&Ct(mt,jt);ni&&mn?(Oe==0?(bn=_e,Ee=Xt):(bn=se,Ee=Vt),We=v[ut],Yn=N(Ge(bn,It),We,$,0),Fn=N(Ge(bn+Ee,It),We,$,0),Lo(wi(Yn,Fn),an(Fn-Yn))):Lo(0,$),pi&&_n?(Oe==1?(bn=_e,Ee=Xt):(bn=se,Ee=Vt),We=v[mt],Yn=Y(Ge(bn,jt),We,rt,0),Fn=Y(Ge(bn+Ee,jt),We,rt,0),Io(wi(Yn,Fn),an(Fn-Yn))):Io(0,rt)}else ac()}else{let ut=an(lf-of),mt=an(cf-af);if(A.ori==1){let jt=ut;ut=mt,mt=jt}mn=yn.x&&ut>=yn.dist,_n=yn.y&&mt>=yn.dist;let Pt=yn.uni;Pt!=null?mn&&_n&&(mn=ut>=Pt,_n=mt>=Pt,!mn&&!_n&&(mt>ut?_n=!0:mn=!0)):yn.x&&yn.y&&(mn||_n)&&(mn=_n=!0);let Ct,It;mn&&(A.ori==0?(Ct=Ar,It=Ue):(Ct=Rr,It=Ve),Lo(wi(Ct,It),an(It-Ct)),_n||Io(0,rt)),_n&&(A.ori==1?(Ct=Ar,It=Ue):(Ct=Rr,It=Ve),Io(wi(Ct,It),an(It-Ct)),mn||Lo(0,$)),!mn&&!_n&&(Lo(0,0),Io(0,0))}if(yn._x=mn,yn._y=_n,g==null){if(R){if(yf!=null){let[ut,mt]=Ze.scales;Ze.values[0]=ut!=null?Ii(A.ori==0?Ue:Ve,ut):null,Ze.values[1]=mt!=null?Ii(A.ori==1?Ue:Ve,mt):null}Do(mc,n,Ue,Ve,Q,W,I)}if(Gi){let ut=R&&Ze.setSeries,mt=Xn.prox;Vs==null?Yi<=mt&&Li(Ms,Cr,!0,ut):Yi>mt?Li(null,Cr,!0,ut):Ms!=Vs&&Li(Ms,Cr,!0,ut)}}it&&(vt.idx=I,sc()),y!==!1&&gn("setCursor")}let ys=null;Object.defineProperty(n,"rect",{get(){return ys==null&&Fo(!1),ys}});function Fo(g=!1){g?ys=null:(ys=_.getBoundingClientRect(),gn("syncRect",ys))}function ff(g,y,R,I,k,$,rt){pt._lock||vs&&g!=null&&g.movementX==0&&g.movementY==0||(rc(g,y,R,I,k,$,rt,!1,g!=null),g!=null?Hs(null,!0,!0):Hs(y,!0,!1))}function rc(g,y,R,I,k,$,rt,ut,mt){if(ys==null&&Fo(!1),sn(g),g!=null)R=g.clientX-ys.left,I=g.clientY-ys.top;else{if(R<0||I<0){Ue=-10,Ve=-10;return}let[Pt,Ct]=Ze.scales,It=y.cursor.sync,[jt,ve]=It.values,[_e,se]=It.scales,[Xt,Vt]=Ze.match,Oe=y.axes[0].side%2==1,Ge=A.ori==0?Q:W,bn=A.ori==1?Q:W,Ee=Oe?$:k,We=Oe?k:$,Yn=Oe?I:R,Fn=Oe?R:I;if(_e!=null?R=Xt(Pt,_e)?a(jt,v[Pt],Ge,0):-10:R=Ge*(Yn/Ee),se!=null?I=Vt(Ct,se)?a(ve,v[Ct],bn,0):-10:I=bn*(Fn/We),A.ori==1){let ni=R;R=I,I=ni}}mt&&(y==null||y.cursor.event.type==mc)&&((R<=1||R>=Q-1)&&(R=Zs(R,Q)),(I<=1||I>=W-1)&&(I=Zs(I,W))),ut?(of=R,af=I,[Ar,Rr]=pt.move(n,R,I)):(Ue=R,Ve=I)}const oc={width:0,height:0,left:0,top:0};function ac(){ma(oc,!1)}let df,pf,mf,_f;function gf(g,y,R,I,k,$,rt){vs=!0,mn=_n=yn._x=yn._y=!1,rc(g,y,R,I,k,$,rt,!0,!1),g!=null&&(Lt(_c,mh,bf,!1),Do(Lf,n,Ar,Rr,Q,W,null));let{left:ut,top:mt,width:Pt,height:Ct}=Ne;df=ut,pf=mt,mf=Pt,_f=Ct}function bf(g,y,R,I,k,$,rt){vs=yn._x=yn._y=!1,rc(g,y,R,I,k,$,rt,!1,!0);let{left:ut,top:mt,width:Pt,height:Ct}=Ne,It=Pt>0||Ct>0,jt=df!=ut||pf!=mt||mf!=Pt||_f!=Ct;if(It&&jt&&ma(Ne),yn.setScale&&It&&jt){let ve=ut,_e=Pt,se=mt,Xt=Ct;if(A.ori==1&&(ve=mt,_e=Ct,se=ut,Xt=Pt),mn&&xs(P,Ii(ve,P),Ii(ve+_e,P)),_n)for(let Vt in v){let Oe=v[Vt];Vt!=P&&Oe.from==null&&Oe.min!=Le&&xs(Vt,Ii(se+Xt,Vt),Ii(se,Vt))}ac()}else pt.lock&&(pt._lock=!pt._lock,Hs(y,!0,g!=null));g!=null&&(C(_c,mh),Do(_c,n,Ue,Ve,Q,W,null))}function ug(g,y,R,I,k,$,rt){if(pt._lock)return;sn(g);let ut=vs;if(vs){let mt=!0,Pt=!0,Ct=10,It,jt;A.ori==0?(It=mn,jt=_n):(It=_n,jt=mn),It&&jt&&(mt=Ue<=Ct||Ue>=Q-Ct,Pt=Ve<=Ct||Ve>=W-Ct),It&&mt&&(Ue=Ue<Ar?0:Q),jt&&Pt&&(Ve=Ve<Rr?0:W),Hs(null,!0,!0),vs=!1}Ue=-10,Ve=-10,_t.fill(null),Hs(null,!0,!0),ut&&(vs=ut)}function vf(g,y,R,I,k,$,rt){pt._lock||(sn(g),Ft(),ac(),g!=null&&Do(Df,n,Ue,Ve,Q,W,null))}function xf(){w.forEach(lv),ot(n.width,n.height,!0)}ur(xl,io,xf);const Lr={};Lr.mousedown=gf,Lr.mousemove=ff,Lr.mouseup=bf,Lr.dblclick=vf,Lr.setSeries=(g,y,R,I)=>{let k=Ze.match[2];R=k(n,y,R),R!=-1&&Li(R,I,!0,!1)},lt&&(Lt(Lf,_,gf),Lt(mc,_,ff),Lt(If,_,g=>{sn(g),Fo(!1)}),Lt(Ff,_,ug),Lt(Df,_,vf),Sh.add(n),n.syncRect=Fo);const _a=n.hooks=i.hooks||{};function gn(g,y,R){tc?Co.push([g,y,R]):g in _a&&_a[g].forEach(I=>{I.call(null,n,y,R)})}(i.plugins||[]).forEach(g=>{for(let y in g.hooks)_a[y]=(_a[y]||[]).concat(g.hooks[y])});const Mf=(g,y,R)=>R,Ze=Qe({key:null,setSeries:!1,filters:{pub:Xf,sub:Xf},scales:[P,M[1]?M[1].scale:null],match:[Yf,Yf,Mf],values:[null,null]},pt.sync);Ze.match.length==2&&Ze.match.push(Mf),pt.sync=Ze;const yf=Ze.key,lc=zm(yf);function Do(g,y,R,I,k,$,rt){Ze.filters.pub(g,y,R,I,k,$,rt)&&lc.pub(g,y,R,I,k,$,rt)}lc.sub(n);function fg(g,y,R,I,k,$,rt){Ze.filters.sub(g,y,R,I,k,$,rt)&&Lr[g](null,y,R,I,k,$,rt)}n.pub=fg;function dg(){lc.unsub(n),Sh.delete(n),de.clear(),bh(xl,io,xf),c.remove(),at?.remove(),gn("destroy")}n.destroy=dg;function cc(){gn("init",i,t),Ot(t||i.data,!1),X[P]?ec(P,X[P]):Ft(),yt=Ne.show&&(Ne.width>0||Ne.height>0),z=it=!0,ot(i.width,i.height)}return M.forEach(Po),w.forEach(Jl),e?e instanceof HTMLElement?(e.appendChild(c),cc()):e(n,cc):cc(),n}cn.assign=Qe;cn.fmtNum=Ru;cn.rangeNum=Ml;cn.rangeLog=Nl;cn.rangeAsinh=Tu;cn.orient=gr;cn.pxRatio=xe;cn.join=Qb;cn.fmtDate=Cu,cn.tzDate=h0;cn.sync=zm;{cn.addGap=Y0,cn.clipGaps=Bl;let i=cn.paths={points:Ym};i.linear=jm,i.stepped=$0,i.bars=Z0,i.spline=J0}const Jm='system-ui, "DejaVu Sans", sans-serif',Sl="#1d2733",pd="#dde3ea",md=i=>i.replace(/[&<>"]/g,t=>({"&":"&amp;","<":"&lt;",">":"&gt;",'"':"&quot;"})[t]??t);class cv{constructor(){this.parts=[]}line(t,e,n,s){const r=t.map(l=>l.toFixed(2)),o=r.flatMap((l,c)=>c%2===0?[`${l},${r[c+1]}`]:[]),a=s.length>0?` stroke-dasharray="${s.join(" ")}"`:"";this.parts.push(`<polyline points="${o.join(" ")}" fill="none" stroke="${e}" stroke-width="${n}" stroke-linejoin="round"${a}/>`)}box(t,e,n,s,r){const o=`x="${t.toFixed(2)}" y="${e.toFixed(2)}"`,a=`width="${n.toFixed(2)}" height="${s.toFixed(2)}"`;this.parts.push(`<rect ${o} ${a} fill="${r}"/>`)}text(t,e,n,s,r){const o=`x="${t.toFixed(2)}" y="${e.toFixed(2)}"`;this.parts.push(`<text ${o} font-size="${s}" text-anchor="${r}">${md(n)}</text>`)}turnedText(t,e,n,s){const r=`transform="translate(${t} ${e}) rotate(-90)"`;this.parts.push(`<text ${r} font-size="${s}" text-anchor="middle">${md(n)}</text>`)}finish(t,e){return`<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${t} ${e}" width="${t}" height="${e}" font-family='${Jm}' fill="${Sl}">
${this.parts.join(`
`)}
</svg>
`}}class hv{constructor(t){this.context=t}line(t,e,n,s){const r=this.context;r.strokeStyle=e,r.lineWidth=n,r.lineJoin="round",r.setLineDash(s),r.beginPath();for(let o=0;o<t.length;o+=2)r.lineTo(t[o],t[o+1]);r.stroke()}box(t,e,n,s,r){this.context.fillStyle=r,this.context.fillRect(t,e,n,s)}text(t,e,n,s,r){const o=this.context;o.font=`${s}px ${Jm}`,o.textAlign=r==="middle"?"center":r,o.fillStyle=Sl,o.fillText(n,t,e)}turnedText(t,e,n,s){this.context.save(),this.context.translate(t,e),this.context.rotate(-Math.PI/2),this.text(0,0,n,s,"middle"),this.context.restore()}}function wl(i,t,e){const n=(t-i)/e;if(!(n>0))return[i];const s=10**Math.floor(Math.log10(n)),r=[1,2,5,10].map(a=>a*s).find(a=>a>=n)??10*s,o=[];for(let a=Math.ceil(i/r-1e-9);a*r<=t+1e-9*r;++a)o.push(Number((a*r).toPrecision(12)));return o}function Qm(i){let[t,e]=[0,0];for(const s of i)for(const r of s)r<t&&(t=r),r>e&&(e=r);t===e&&(e=t+1);const n=.06*(e-t);return[t===0?0:t-n,e===0?0:e+n]}function Eh(i){let[t,e]=[1/0,-1/0];for(const{xs:n}of i.curves)for(const s of n)s<t&&(t=s),s>e&&(e=s);return t<e?[t,e]:[0,1]}function t_(i,t,e,n){const[s,r,o,a]=[64,20,64,48],[l,c]=[e-s-r,n-o-a],[h,f]=Eh(i),[u,p]=Qm(i.curves.map(d=>d.ys)),_=d=>s+(d-h)/(f-h)*l,b=d=>o+(p-d)/(p-u)*c;t.box(0,0,e,n,"#ffffff"),t.text(s,24,i.title,16,"start"),i.bands.forEach((d,M)=>{const[w,v]=[_(Math.max(h,d.from)),_(Math.min(f,d.to))];v<=w||(t.box(w,o,v-w,c,M%2===0?"#f3f5f8":"#e8ecf1"),v-w>40&&t.text((w+v)/2,o+c-6,d.label,11,"middle"))});for(const d of wl(h,f,8))t.line([_(d),o,_(d),o+c],pd,1,[]),t.text(_(d),o+c+18,String(d),12,"middle");for(const d of wl(u,p,6))t.line([s,b(d),s+l,b(d)],pd,1,[]),t.text(s-8,b(d)+4,String(d),12,"end");t.line([s,o,s,o+c,s+l,o+c],Sl,1,[]);for(const d of i.marks)d.x<h||d.x>f||(t.line([_(d.x),o,_(d.x),o+c],Sl,1,d.strong?[]:[2,3]),t.text(_(d.x)+3,o+12,d.label,11,"start"));for(const d of i.curves){const M=d.xs.flatMap((w,v)=>[_(w),b(d.ys[v])]);t.line(M,d.colour,d.width,d.dash)}let m=s;for(const d of i.curves)t.line([m,46,m+26,46],d.colour,d.width,d.dash),t.text(m+31,50,d.name,12,"start"),m+=44+7*d.name.length;t.text(s+l/2,n-10,i.xLabel,13,"middle"),t.turnedText(18,o+c/2,i.yLabel,13)}const El=960,Tl=480;function uv(i){const t=new cv;return t_(i,t,El,Tl),t.finish(El,Tl)}function e_(i,t=2){const e=document.createElement("canvas");e.width=El*t,e.height=Tl*t;const n=e.getContext("2d");return n!==null&&(n.scale(t,t),t_(i,new hv(n),El,Tl)),e}function fv(i,t,e){const n=[i.join(",")];for(let s=0;s<(t[0]?.length??0);++s)n.push(t.map(r=>e(r[s])).join(","));return`${n.join(`
`)}
`}const _d=110,dv=20,pv=.6;class gd{constructor(t){this.name=t,this.place=tt("div",{class:"plot-place"}),this.summary=tt("p",{class:"quiet-text"}),this.u=null,this.root=tt("div",{class:"plot"},this.place,this.summary),new ResizeObserver(()=>{const e=this.place.clientWidth;this.u!==null&&e>0&&this.u.setSize({width:e,height:_d})}).observe(this.place)}show(t,e){if(this.place.clientWidth===0)return;let n=dv;t.forEach((c,h)=>{c>0&&(n=Math.max(n,h+1))});const s=Array.from(t.subarray(0,n)),r=s.map((c,h)=>(h+.5)*e),o=s.map(c=>c>0?c:null),a=s.reduce((c,h)=>c+h,0),l=n*e;xn(this.summary,`${this.name}: ${a} ${O.loop.ticksAxis}, < ${l} ${O.loop.usAxis}`),this.u===null?this.u=new cn(this.options(),[r,o],this.place):this.u.setData([r,o])}options(){const t=()=>dr()?"#c3ccd6":"#43505e",e={stroke:t,font:"11px system-ui, sans-serif",grid:{show:!1},ticks:{size:3,stroke:t,width:1},gap:3};return{width:this.place.clientWidth,height:_d,legend:{show:!1},cursor:{show:!1},padding:[6,10,0,0],scales:{x:{time:!1,range:(n,s,r)=>[0,r]},y:{distr:3,range:(n,s,r)=>[pv,Math.max(10,2*r)]}},axes:[{...e,size:22,splits:(n,s,r,o)=>wl(r,o,6),values:(n,s)=>s.map(r=>`${r} ${O.loop.usAxis}`)},{...e,size:44,splits:(n,s,r,o)=>Array.from({length:Math.floor(Math.log10(o))+1},(a,l)=>10**l),values:(n,s)=>s.map(r=>r===null?"":r<1e4?String(r):r.toExponential(0))}],series:[{},{fill:()=>dr()?"#56b4e9":"#0072b2",width:0,points:{show:!1},paths:cn.paths.bars?.({size:[.9,40]})}]}}}class mv{constructor(t,e,n){this.store=t,this.view=e,this.plotMs=n,this.counts=tt("dl",{class:"facts"}),this.quantiles=tt("div"),this.guard=tt("dl",{class:"facts"}),this.budget=tt("dl",{class:"facts"}),this.ticks=new gd(O.loop.tick),this.late=new gd(O.loop.late),this.redraw=sm(500,()=>this.draw()),this.root=Ns("loop",O.loop.heading,"engineer",this.counts,tt("h3",{},O.loop.tick),this.ticks.root,tt("h3",{},O.loop.late),this.late.root,this.quantiles,tt("h3",{},O.loop.guard),this.guard,tt("h3",{},O.loop.page),this.budget),t.on(["frame","view"],this.redraw)}draw(){const{frame:t}=this.store;if(t===null||this.store.view!=="engineer")return;t.timing!==null&&this.drawTiming(t.timing);const e=t.needles[this.store.needle];if(e){const s=O.loop.flagNames.filter((l,c)=>(e.flags>>>c&1)===1);e.flags>>>31===1&&s.push(O.loop.kernelFault);const{x:r,y:o,z:a}=e.command;Mc(this.guard,[[O.loop.guard,e.guard||O.scores.dash],[O.loop.command,`${[r,o,a].map(l=>l.toFixed(3)).join(", ")} N`],[O.loop.flags,s.join(", ")||O.loop.none],[O.loop.particles,String(t.particles.length)]])}const n=this.view()?.budget;n&&Mc(this.budget,[...["message","deform","bodies","caps","face","draw"].map(s=>[O.loop.parts[s],O.loop.ms(n.median(s))]),[O.loop.parts.plots,O.loop.ms(this.plotMs())]])}drawTiming(t){const e=O.loop.counts,n=r=>t[r].toLocaleString("en");Mc(this.counts,Object.keys(e).map(r=>[e[r],n(r)])),this.ticks.show(t.tickBins,t.binUs),this.late.show(t.lateBins,t.binUs);const s=O.loop.quantiles.map((r,o)=>[r,O.units.us(t.tickUs[o]??0),O.units.us(t.lateUs[o]??0)]);this.quantiles.replaceChildren(_l([O.loop.quantile,O.loop.tick,O.loop.late],s))}}function Mc(i,t){for(;i.children.length>t.length;)i.lastChild?.remove();t.forEach(([e,n],s)=>{i.children[s]||i.append(tt("div",{},tt("dt"),tt("dd")));const[r,o]=i.children[s].children;xn(r,e),xn(o,n)})}const _v=[-1,.1,.25,.5,1,2,4,8],gv=400;class bv{constructor(t,e){this.store=t,this.send=e,this.bar=tt("input",{type:"range",min:0,max:0,step:1,value:0,class:"scrub","aria-label":O.playback.position}),this.play=$e(O.playback.play,()=>this.toggle(),{class:"primary"}),this.time=tt("span",{class:"clock"}),this.speed=tt("select"),this.flags=tt("div",{class:"flags","aria-hidden":"true"}),this.playing=!1,this.wanted=null,this.askedAt=-1/0,this.asked=-1,this.rowAsked=-1,this.speed.append(..._v.map(n=>tt("option",{value:n},O.playback.speedOf(n)))),this.speed.value="1",this.root=tt("section",{class:"playback","aria-label":O.playback.heading,hidden:!0},this.play,$e("|<",()=>this.toEvent(-1),{"aria-label":O.playback.lastEvent}),$e("<",()=>this.seek(this.tick-1),{"aria-label":O.playback.back}),$e(">",()=>this.seek(this.tick+1),{"aria-label":O.playback.forward}),$e(">|",()=>this.toEvent(1),{"aria-label":O.playback.nextEvent}),tt("div",{class:"scrub-place"},this.bar,this.flags),this.time,ta(O.playback.speed,this.speed)),this.bar.addEventListener("input",()=>this.seek(Number(this.bar.value))),this.speed.addEventListener("change",()=>this.playing&&this.sendSpeed()),t.on(["hello"],()=>this.begin()),t.on(["rows"],()=>this.drawFlags()),t.on(["frame"],()=>this.show())}get last(){return this.store.hello?.recordingTicks??0}get tick(){return this.wanted??this.store.frame?.tick??0}toggle(){this.store.playback&&(!this.playing&&this.tick>=this.last&&Number(this.speed.value)>0&&this.seek(0),this.setPlaying(!this.playing),this.sendSpeed())}seek(t){this.store.playback&&(this.wanted=Math.round(Math.min(this.last,Math.max(0,t))),this.playing&&(this.setPlaying(!1),this.sendSpeed()),this.ask())}ask(){this.asked!==this.store.frame?.tick&&performance.now()-this.askedAt<gv||this.wanted!==null&&(this.asked=this.wanted,this.askedAt=performance.now(),this.send(Jn.seek(this.wanted)))}setPlaying(t){this.playing=t,xn(this.play,t?O.playback.hold:O.playback.play)}sendSpeed(){this.send(Jn.play(this.playing?Number(this.speed.value):0))}toEvent(t){const e=[...this.store.events,...this.store.marks].map(s=>s.tick).sort((s,r)=>s-r),n=t>0?e.find(s=>s>this.tick):e.reverse().find(s=>s<this.tick);this.seek(n??(t>0?this.last:0))}begin(){this.root.hidden=!this.store.playback,this.bar.max=String(this.last),this.wanted=null,this.asked=-1,this.setPlaying(!1),this.drawFlags()}show(){const{frame:t}=this.store;if(t===null||!this.store.playback)return;this.wanted===t.tick?this.wanted=null:this.wanted!==null&&this.ask(),this.wanted===null&&(this.bar.value=String(t.tick)),this.wanted===null&&!this.playing&&this.askExactRow(t.tick),this.playing&&t.tick>=this.last&&Number(this.speed.value)>0&&this.setPlaying(!1);const[e,n]=[t.tick,this.last].map(s=>this.store.seconds(s).toFixed(3));xn(this.time,O.playback.at(e,n)),this.bar.setAttribute("aria-valuetext",O.playback.at(e,n))}askExactRow(t){t===this.rowAsked||this.store.rows.near(t)?.tick===t||(this.rowAsked=t,this.send(Jn.rows(t,t,1)))}drawFlags(){if(this.last===0)return;const t=(e,n)=>{const s=tt("span",{class:n});return s.style.left=`${(100*e/this.last).toFixed(3)}%`,s};this.flags.replaceChildren(...this.store.events.map(e=>t(e.tick,"flag")),...this.store.marks.map(e=>t(e.tick,"flag mark")))}}const vv=.005,xv=2e-4;var na=(i=>(i[i.Contact=0]="Contact",i[i.Release=1]="Release",i[i.Puncture=2]="Puncture",i[i.Reentry=3]="Reentry",i[i.Exit=4]="Exit",i[i.Layer=5]="Layer",i[i.Obstacle=6]="Obstacle",i))(na||{});function Mv(i,t,e){const[n,s]=[i.find(t),i.find(e+1)-1],[r,o]=[i.column("tick"),i.column("travel")];let a=n,l=n;for(let c=n;c<=s;++c)o[c]>=o[a]&&(a=c);for(let c=a;c<=s&&o[c]>o[a]-xv;++c)l=c;return s>l&&o[a]-o[s]>vv?r[l]:null}const yv=i=>i?.phase==="inserted";function Sv(i,t,e){const n=t.column("tick"),s=n[n.length-1]??0,r=[];let o=null;const a=l=>{o!==null&&r.push({...o,to:l}),o=null};for(const l of i.filter(c=>c.needle===e))if(l.eventKind===0)a(l.tick),o={phase:"contact",from:l.tick,to:s};else if(l.eventKind===2||l.eventKind===3){if(yv(o))continue;a(l.tick),o={phase:"inserted",from:l.tick,to:s}}else(l.eventKind===1||l.eventKind===4)&&a(l.tick);return a(s),r.flatMap(l=>{const c=l.phase==="inserted"?Mv(t,l.from,l.to):null;return c===null?[l]:[{...l,to:c},{phase:"retracting",from:c,to:l.to}]})}const n_=500;function el(i,t,e,n,s){return{name:i,colour:hb(t,dr()),dash:t.dash,width:e,xs:n,ys:s}}function i_(i,t,e,n,s){const r=(l,c=1)=>{const h=i.column(l);return t.map(f=>c*h[f])},o=r(n,e),a=fh.map(l=>el(O.force.causes[l],bl[l],1.4,o,r(l)));return[el(s?O.force.total:O.force.axial,Mu,1.8,o,r("force")),...s?a:[el(O.force.lateral,vl,1.2,o,r("lateral"))]]}function wv(i){return O.force.phases[{contact:1,inserted:2,retracting:3}[i]]}function Ev(i,t,e){const{rows:n,period:s}=i,r=e===null?0:Math.max(0,n.find(e[0]/s)-1),o=e===null?n.length:Math.min(n.length,n.find(e[1]/s)+1),a=um(n.column("force"),r,o,n_),l=i.needle;return{title:O.plots.time,xLabel:O.plots.timeAxis,yLabel:O.plots.forceAxis,curves:i_(n,a,s,"tick",t),bands:Sv(i.events,n,l).map(({phase:c,from:h,to:f})=>({from:i.seconds(h),to:i.seconds(f),label:wv(c)})),marks:[...i.events.filter(c=>c.needle===l).map(c=>({x:i.seconds(c.tick),label:s_(i,c.eventKind,c.layer),strong:!1})),...i.marks.map(c=>({x:i.seconds(c.tick),label:c.text,strong:!0}))]}}function s_(i,t,e){const n=O.plots.events[t]??String(t),s=t===na.Layer||t===na.Puncture,r=i.layerName(e);return s&&r!==""?`${n}: ${r}`:n}function Tv(i,t){const{rows:e}=i,n=um(e.column("force"),0,e.length,n_),s=e.column("travel"),r=i.events.filter(o=>o.needle===i.needle).filter(o=>o.eventKind===na.Puncture||o.eventKind===na.Layer).flatMap(o=>{const a=e.find(o.tick);return a>=e.length?[]:[{x:1e3*s[a],label:s_(i,o.eventKind,o.layer),strong:!1}]});return{title:O.plots.depth,xLabel:O.plots.depthAxis,yLabel:O.plots.forceAxis,curves:i_(e,n,1e3,"travel",t),bands:[],marks:r}}const bd=(i,t)=>el(O.scores.attempt(i.attempt),t,1.6,i.rows.map(e=>1e3*e.travel),i.rows.map(e=>e.force));function Av(i,t){return{title:O.compare.plot,xLabel:O.plots.depthAxis,yLabel:O.plots.forceAxis,curves:[bd(i,lm),bd(t,cm)],bands:[],marks:[]}}function Rv(i,t){const e=i.rows.map(n=>n.tick*t);return{title:O.scores.attempt(i.attempt),xLabel:O.plots.timeAxis,yLabel:O.plots.forceAxis,curves:[{name:O.force.axial,colour:Mu.colour,dash:[],width:1.6,xs:e,ys:i.rows.map(n=>n.force)},{name:O.force.lateral,colour:vl.colour,dash:vl.dash,width:1.2,xs:e,ys:i.rows.map(n=>n.lateral)}],bands:[],marks:i.punctures.map(n=>({x:n.tick*t,label:n.layer,strong:!1}))}}const Ma=()=>dr()?"#c3ccd6":"#43505e",vd=()=>dr()?"#2b343e":"#e2e7ed",Pv=i=>(dr()?["#1c232b","#222a33"]:["#f4f6f9","#eaeef3"])[i%2];function Cv(i,t){const e=new Path2D;return cn.orient(i,t,(n,s,r,o,a,l,c,h,f,u,p)=>{const[_,b]=[s,r];for(let m=0;m<_.length;++m)e.lineTo(l(_[m],o,u,h),c(b[m],a,p,f));return null}),{stroke:e}}class Th{constructor(t){this.options=t,this.place=tt("div",{class:"plot-place"}),this.legend=tt("ul",{class:"legend","aria-label":O.plots.legend}),this.summary=tt("p",{class:"quiet-text"}),this.u=null,this.figure=null,this.shape="",this.cursor=null,this.range=null;const{png:e,svg:n,csv:s}=O.plots,r=tt("div",{class:"plot-tools"},$e(e,()=>this.savePng(),{"aria-label":O.plots.exportLabel(e)}),$e(n,()=>this.saveSvg(),{"aria-label":O.plots.exportLabel(n)}),$e(s,()=>this.saveCsv(),{"aria-label":O.plots.exportLabel(s)}));this.root=tt("div",{class:"plot"},this.place,tt("div",{class:"plot-foot"},this.legend,r),this.summary),this.listen(),new ResizeObserver(()=>this.fit()).observe(this.place),matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>{this.shape="",this.figure!==null&&this.show(this.figure)})}get visible(){return this.place.offsetParent!==null}show(t){if(this.figure=t,!this.visible)return;const e=t.curves.map(o=>o.name+o.colour).join()+t.xLabel,n=[null,...t.curves.map(o=>[o.xs,o.ys])];this.u===null||e!==this.shape?(this.shape=e,this.u?.destroy(),this.u=new cn(this.uplotOptions(t),n,this.place),this.drawLegend(t.curves)):this.u.setData(n);const s=Math.max(0,...t.curves.slice(0,1).map(o=>Lv(o.ys))),r=O.plots.description(t.title,t.curves[0]?.xs.length??0,s);xn(this.summary,this.options.step?`${r} ${O.plots.keyboard}`:r)}setCursor(t){this.cursor!==t&&(this.cursor=t,this.visible&&this.u?.redraw(!1))}setRange(t){this.range=t,this.figure!==null&&this.show(this.figure)}uplotOptions(t){const e=(s,r)=>({label:s,labelSize:18,size:r,font:"11px system-ui, sans-serif",labelFont:"12px system-ui, sans-serif",stroke:Ma,grid:{stroke:vd,width:1},ticks:{stroke:vd,width:1,size:4},gap:3,splits:(o,a,l,c)=>wl(l,c,s===t.xLabel?6:5),values:(o,a)=>a.map(String)}),n=s=>({label:s.name,stroke:s.colour,width:s.width,dash:s.dash,paths:Cv,facets:[{scale:"x",auto:!0},{scale:"y",auto:!0}]});return{mode:2,width:Math.max(120,this.place.clientWidth),height:this.options.height,legend:{show:!1},padding:[8,10,0,0],cursor:{show:!1},scales:{x:{time:!1,range:()=>this.range??Eh(this.now())},y:{range:()=>Qm(this.now().curves.map(s=>s.ys))}},axes:[e(t.xLabel,30),e(t.yLabel,38)],series:[{},...t.curves.map(n)],hooks:{drawClear:[s=>this.drawBands(s)],draw:[s=>this.drawMarks(s)]}}}now(){return this.figure??{title:"",xLabel:"",yLabel:"",curves:[],bands:[],marks:[]}}drawBands(t){const{ctx:e,bbox:n}=t,s=devicePixelRatio;e.save(),e.beginPath(),e.rect(n.left,n.top,n.width,n.height),e.clip(),e.font=`${10.5*s}px system-ui, sans-serif`,e.textAlign="center",this.now().bands.forEach((r,o)=>{const[a,l]=[t.valToPos(r.from,"x",!0),t.valToPos(r.to,"x",!0)];e.fillStyle=Pv(o),e.fillRect(a,n.top,l-a,n.height);const c=(Math.max(a,n.left)+Math.min(l,n.left+n.width))/2;l-a<e.measureText(r.label).width+8*s||(e.fillStyle=Ma(),e.fillText(r.label,c,n.top+n.height-5*s))}),e.restore()}drawMarks(t){const{ctx:e,bbox:n}=t,s=devicePixelRatio,r=(a,l,c,h)=>{e.strokeStyle=l,e.lineWidth=h*s,e.setLineDash(c.map(f=>f*s)),e.beginPath(),e.moveTo(a,n.top),e.lineTo(a,n.top+n.height),e.stroke()};e.save(),e.beginPath(),e.rect(n.left,n.top,n.width,n.height),e.clip(),e.font=`${10.5*s}px system-ui, sans-serif`,e.textAlign="left";let o=[-1/0,-1/0];for(const a of this.now().marks){const l=t.valToPos(a.x,"x",!0);r(l,Ma(),a.strong?[]:[2,3],1);const c=o.findIndex(h=>h<l);c<0||(e.fillStyle=Ma(),e.fillText(a.label,l+3*s,n.top+(11+13*c)*s),o=o.map((h,f)=>f===c?l+e.measureText(a.label).width+8*s:h))}this.cursor!==null&&r(t.valToPos(this.cursor,"x",!0),dr()?"#ffffff":"#101820",[],1.5),e.restore()}drawLegend(t){this.legend.replaceChildren(...t.map(e=>{const n=document.createElementNS("http://www.w3.org/2000/svg","svg"),s=document.createElementNS("http://www.w3.org/2000/svg","line"),r=(o,a)=>Object.entries(a).forEach(([l,c])=>o.setAttribute(l,c));return r(n,{viewBox:"0 0 24 8",class:"swatch","aria-hidden":"true"}),r(s,{x1:"0",x2:"24",y1:"4",y2:"4",stroke:e.colour}),r(s,{"stroke-width":String(e.width),"stroke-dasharray":e.dash.join(" ")}),n.append(s),tt("li",{},n,e.name)}))}fit(){const t=this.place.clientWidth;t!==0&&(this.u===null||this.shape===""?this.figure!==null&&this.show(this.figure):Math.abs(this.u.width-t)>1&&this.u.setSize({width:t,height:this.options.height}))}xAt(t){return this.u===null?null:this.u.posToVal(t.clientX-this.u.over.getBoundingClientRect().left,"x")}listen(){const{seek:t,step:e,zoom:n}=this.options;if(e!==void 0&&(this.place.tabIndex=0,this.place.setAttribute("role","group"),this.place.addEventListener("keydown",s=>{const r={ArrowLeft:-1,ArrowRight:1,PageDown:-50,PageUp:50}[s.key];r!==void 0&&(s.preventDefault(),e(r))})),t!==void 0){const s=(r,o)=>{const a=this.xAt(r);a!==null&&t(a,o)};this.place.addEventListener("pointerdown",r=>{this.place.setPointerCapture(r.pointerId),s(r,!0)}),this.place.addEventListener("pointermove",r=>r.buttons===1&&s(r,!1)),this.place.addEventListener("pointerup",r=>s(r,!0))}n!==void 0&&(this.place.addEventListener("dblclick",()=>n(null)),this.place.addEventListener("wheel",s=>{const r=this.xAt(s);if(r===null||!s.ctrlKey)return;s.preventDefault();const[o,a]=this.range??Eh(this.now()),l=s.deltaY<0?.7:1.4;n([r-(r-o)*l,r+(a-r)*l])},{passive:!1}))}savePng(){this.figure!==null&&e_(this.printed()).toBlob(t=>{t!==null&&hc(`${this.options.name}.png`,"image/png",t)})}saveSvg(){this.figure!==null&&hc(`${this.options.name}.svg`,"image/svg+xml",uv(this.printed()))}saveCsv(){const{head:t,columns:e}=this.options.numbers();hc(`${this.options.name}.csv`,"text/csv",fv(t,e,Qa))}printed(){const t=this.now();return{...t,curves:t.curves.map(e=>({...e,colour:ub(e.colour)}))}}}const Lv=i=>i.reduce((t,e)=>Math.max(t,Math.abs(e)),0),Iv=150,Fv=20,Dv=2e3;class Uv{constructor(t,e,n){this.store=t,this.send=e,this.drawMs=0,this.byCause=!1,this.recent=!1,this.zoomed=null,this.redraw=sm(Iv,()=>this.draw());const s=()=>({head:["tick","time_s",...Ov],columns:[t.rows.column("tick"),t.rows.column("tick").map(r=>Number((r*t.period).toPrecision(9))),...to.slice(1).map(r=>t.rows.column(r))]});this.time=new Th({name:"force-time",height:176,numbers:s,seek:r=>t.playback&&n(r/t.period),step:r=>t.playback&&n((t.frame?.tick??0)+20*r),zoom:r=>this.zoom(r)}),this.depth=new Th({name:"force-depth",height:176,numbers:s}),this.causeSwitch=ph(O.plots.byCause,r=>{this.byCause=r,this.redraw()}),this.windowSwitch=ph(O.plots.window,r=>{this.recent=r,this.redraw()}),this.root=Ns("plots",O.plots.time,"teacher engineer",tt("div",{class:"panel-tools"},this.causeSwitch,this.windowSwitch),this.time.root,tt("h2",{},O.plots.depth),this.depth.root),t.on(["rows","needle","organ"],this.redraw),t.on(["frame"],()=>this.follow()),t.on(["hello"],()=>this.begin()),t.on(["view"],()=>{ml(this.causeSwitch,t.view==="engineer",r=>this.byCause=r),this.redraw()})}begin(){this.zoomed=null,this.windowSwitch.hidden=this.store.playback,this.store.playback&&this.askRows(0,this.store.hello?.recordingTicks??0),this.redraw()}askRows(t,e){this.send(Jn.rows(Math.max(0,Math.floor(t)),Math.ceil(e),Dv))}zoom(t){const e=this.store.seconds(this.store.hello?.recordingTicks??0);if(this.zoomed=t,t!==null&&this.store.playback){const[n,s]=[Math.max(0,t[0]),Math.min(e,t[1])];this.zoomed=[n,s],this.askRows(n/this.store.period,s/this.store.period)}this.redraw()}follow(){const{frame:t,playback:e}=this.store;if(!e||t===null)return;this.time.setCursor(this.store.seconds(t.tick));const n=this.store.rows.near(t.tick);this.depth.setCursor(n===null?null:1e3*n.travel)}range(){if(this.zoomed!==null)return this.zoomed;const t=this.store.rows.column("tick"),e=this.store.seconds(t[t.length-1]??0);return this.recent&&!this.store.playback?[Math.max(0,e-Fv),e]:null}draw(){const t=performance.now(),e=this.range(),n=(s,r)=>s.visible&&s.show(r());this.time.setRange(e),n(this.time,()=>Ev(this.store,this.byCause,e)),n(this.depth,()=>Tv(this.store,this.byCause)),this.follow(),this.drawMs=performance.now()-t}}const Nv={depth:"depth_m",travel:"travel_m",tickUs:"tick_us",lateUs:"late_us"},Ov=to.slice(1).map(i=>Nv[i]??`${i}_n`),kv=25e-5,Bv=.15,zv=.02,Vv=90,xd=.2,Md=.3,yd={KeyW:["z",-1],KeyS:["z",1],KeyA:["x",-1],KeyD:["x",1],KeyR:["y",1],KeyF:["y",-1],KeyQ:["roll",1],KeyE:["roll",-1]};function Hv(i){const t=i*Math.PI/360;return{w:Math.cos(t),x:0,y:0,z:Math.sin(t)}}const Sd="stylet.pointer",Fr=i=>Math.min(Md,Math.max(-Md,i)),wd=360;function Gv(i,t){const e=(Math.atan2(t.y,t.x)-Math.atan2(i.y,i.x))*180/Math.PI;return e-wd*Math.round(e/wd)}class Wv{constructor(t,e){this.store=t,this.send=e,this.pad=tt("div",{class:"pad",tabindex:0,role:"application","aria-label":O.pointer.pad}),this.stem=tt("div",{class:"stem","aria-hidden":"true"}),this.pull=tt("div",{class:"pull","aria-hidden":"true"}),this.words=tt("p",{class:"pad-words"}),this.place={x:0,y:0,z:0},this.roll=0,this.activity=On.Ready,this.held=new Map,this.pressed=new Set,this.slow=!1,this.stale=!1,this.last=0,this.pad.append(this.pull,this.stem,this.words),this.root=Ns("pointer",O.pointer.heading,"trainee engineer",this.pad,tt("p",{class:"quiet-text"},O.pointer.help),$e(O.pointer.home,()=>this.home())),this.root.hidden=!0,this.listen(),t.on(["hello"],()=>this.begin()),t.on(["frame"],()=>{this.homeWhenReset(),this.showForce()}),requestAnimationFrame(n=>this.step(n))}get needle(){return(this.store.hello?.needles??[]).findIndex(e=>e.device.startsWith("pointer:"))}begin(){this.root.hidden=this.needle<0||this.store.playback||!this.store.hello?.mayControl,this.activity=On.Running,this.takeUp()}keep(){const t={scene:this.store.hello?.scene??"",place:this.place,roll:this.roll};window.sessionStorage.setItem(Sd,JSON.stringify(t))}takeUp(){try{const t=JSON.parse(window.sessionStorage.getItem(Sd)??"{}"),{x:e=0,y:n=0,z:s=0}=t.place??{},r=[e,n,s,t.roll??0];if(t.scene!==this.store.hello?.scene||!r.every(Number.isFinite))return this.home();this.place={x:Fr(e),y:Fr(n),z:Fr(s)},this.roll=t.roll??0,this.changed()}catch{this.home()}}showWords(){const t=this.store.frame?.needles[this.needle]?.tip,e=this.store.hello?.needles[this.needle];if(!t||!e)return xn(this.words,O.pointer.roll(this.roll));const{entry:n,direction:s}=e,r=s.x*(t.x-n.x)+s.y*(t.y-n.y)+s.z*(t.z-n.z);xn(this.words,`${O.pointer.advance(1e3*r)}
${O.pointer.roll(this.roll)}`)}homeWhenReset(){const t=this.store.frame?.activity??On.Ready;t===On.Ready&&this.activity!==On.Ready&&this.home(),this.activity=t}home(){this.place={x:0,y:0,z:0},this.roll=0,this.changed()}changed(){this.stale=!0,this.showWords(),this.keep();const{x:t,z:e}=this.place,[n,s]=[t,-e].map(r=>Math.max(-60,Math.min(60,600*r)));this.stem.style.transform=`translate(${n}px, ${-s}px) rotate(${this.roll}deg)`}drag(t){const e=this.held.get(t.pointerId);if(e===void 0)return;const n={x:t.clientX,y:t.clientY};if(this.held.set(t.pointerId,n),this.held.size===1){const s=kv*(t.shiftKey?xd:1);this.place.x=Fr(this.place.x+s*(n.x-e.x)),this.place.z=Fr(this.place.z+s*(n.y-e.y))}else{const[,s]=[...this.held].find(([o])=>o!==t.pointerId)??[0,n],r=o=>({x:o.x-s.x,y:o.y-s.y});this.roll+=Gv(r(e),r(n))}this.changed()}listen(){const{pad:t}=this;t.addEventListener("pointerdown",e=>{this.held.set(e.pointerId,{x:e.clientX,y:e.clientY}),t.setPointerCapture(e.pointerId),t.classList.add("held"),this.stale=!0}),t.addEventListener("dragstart",e=>e.preventDefault());for(const e of["pointerup","pointercancel","lostpointercapture"])t.addEventListener(e,n=>{this.held.delete(n.pointerId),t.classList.toggle("held",this.held.size>0),this.stale=!0});t.addEventListener("pointermove",e=>this.drag(e)),t.addEventListener("wheel",e=>{e.preventDefault(),this.roll+=Bv*e.deltaY,this.changed()},{passive:!1}),t.addEventListener("keydown",e=>{this.slow=e.shiftKey,!(!(e.code in yd)||e.ctrlKey||e.altKey||e.metaKey)&&(e.preventDefault(),e.stopPropagation(),this.pressed.add(e.code))}),t.addEventListener("keyup",e=>{this.slow=e.shiftKey,this.pressed.delete(e.code)}),t.addEventListener("blur",()=>this.pressed.clear())}step(t){requestAnimationFrame(r=>this.step(r));const e=Math.min(.1,(t-this.last)/1e3);this.last=t;const n=e*(this.slow?xd:1);for(const r of this.pressed){const[o,a]=yd[r];o==="roll"?this.roll+=a*n*Vv:this.place[o]=Fr(this.place[o]+a*n*zv),this.changed()}if(!this.stale||this.root.hidden)return;this.stale=!1;const s=this.held.size>0||this.pressed.size>0?1:0;this.send(Jn.pointer(this.needle,this.place,Hv(this.roll),s))}showForce(){const t=this.store.frame?.needles[this.needle],e=this.store.hello?.needles[this.needle];if(!t||!e||this.root.hidden)return;this.showWords();const{x:n,y:s,z:r}=t.force,o=Math.min(1,Math.hypot(n,s,r)/(e.maxForce||10));this.pull.style.transform=`scaleY(${o.toFixed(3)})`}}const Xv=120;class Yv{constructor(t,e,n){this.store=t,this.seek=n,this.input=tt("input",{type:"text",maxlength:Xv,placeholder:O.marks.hint}),this.list=tt("ol",{class:"marks-list"});const s=tt("form",{class:"row"},ta(O.marks.label,this.input),tt("button",{type:"submit"},O.marks.add));s.addEventListener("submit",r=>{r.preventDefault();const o=this.input.value.trim();o!==""&&(e(Jn.mark(o)),this.input.value="")}),this.root=Ns("marks",O.marks.heading,"teacher",s,this.list),t.on(["marks","hello"],()=>this.show()),this.show()}show(){const t=this.store.allMarks.map(e=>{const n=r_(this.store,e),s=this.store.playback?$e(n,()=>this.seek(e.tick),{class:"link"}):n;return tt("li",{},s)});this.list.replaceChildren(...t.length>0?t:[tt("li",{class:"empty"},O.marks.none)])}}function r_(i,t){const e=O.marks.goTo(i.seconds(t.tick).toFixed(2),t.text);return t.attempt===0?e:`${O.scores.attempt(t.attempt)}, ${e}`}function Al(i){const t=O.scores.lines,{n:e,mm:n,s}=O.units,r=i.targets.filter(h=>!h.forbidden),o=i.targets.filter(h=>h.forbidden),a=r.filter(h=>h.reached).length,l=o.filter(h=>h.reached).length,c=r.length>0?Math.min(...r.map(h=>h.closest)):null;return[[t.duration,s(i.duration),i.duration],[t.path,n(i.path),i.path],[t.depthPath,n(i.depthPath),i.depthPath],[t.punctures,String(i.punctures.length),i.punctures.length],[t.withdrawals,String(i.withdrawals),i.withdrawals],[t.targets,O.scores.of(a,r.length),a],[t.forbidden,O.scores.of(l,o.length),l],[t.closest,c===null?O.scores.dash:n(c),c],[t.peakForce,e(i.peakForce),i.peakForce],[t.peakLateral,e(i.peakLateral),i.peakLateral],[t.meanForce,e(i.meanForce),i.meanForce],[t.faults,String(i.faults),i.faults]]}const ia=i=>i.trainee===""?O.scores.attempt(i.attempt):`${O.scores.attempt(i.attempt)}, ${i.trainee}`;class qv{constructor(t){this.store=t,this.content=tt("div"),this.root=Ns("score",O.scores.heading,"trainee teacher",this.content),t.on(["scores"],()=>this.show()),this.show()}show(){const t=this.store.scores[this.store.scores.length-1];if(t===void 0){this.content.replaceChildren(tt("p",{class:"empty"},O.scores.none));return}const e=tt("dl",{class:"facts"});for(const[s,r]of Al(t))e.append(tt("div",{},tt("dt",{},s),tt("dd",{},r)));const n=t.punctures.map(s=>tt("li",{},O.scores.puncture(s.layer,O.units.n(s.force))));this.content.replaceChildren(tt("p",{class:"attempt"},ia(t)),e,...n.length>0?[tt("h3",{},O.scores.lines.punctures),tt("ul",{class:"plain"},...n)]:[])}}class jv{constructor(t){this.store=t,this.choices=[tt("select"),tt("select")],this.content=tt("div"),this.hint=tt("p",{class:"empty"},O.compare.need),this.plot=new Th({name:"comparison",height:190,numbers:()=>this.numbers()}),this.body=tt("div",{hidden:!0},tt("div",{class:"row"},ta(O.compare.first,this.choices[0]),ta(O.compare.second,this.choices[1])),this.plot.root,this.content),this.root=Ns("compare",O.compare.heading,"teacher",this.hint,this.body);for(const e of this.choices)e.addEventListener("change",()=>this.show());t.on(["scores"],()=>this.refill()),t.on(["view"],()=>this.show())}refill(){const{scores:t}=this.store,e=t.length>=2;this.hint.hidden=e,this.body.hidden=!e,this.choices.forEach((n,s)=>{n.replaceChildren(...t.map(o=>tt("option",{value:o.attempt},ia(o))));const r=t[t.length-2+s];r&&(n.value=String(r.attempt))}),this.show()}chosen(){const[t,e]=this.choices.map(n=>this.store.scores.find(s=>String(s.attempt)===n.value));return t&&e?[t,e]:null}show(){const t=this.chosen();if(t===null||this.body.hidden)return;this.plot.show(Av(...t));const[e,n]=t.map(Al),s=e.map(([o,a,l],c)=>[o,a,n[c][1],$v(l,n[c][2])]),r=[O.compare.what,...t.map(ia),O.compare.difference];this.content.replaceChildren(_l(r,s))}numbers(){const t=this.chosen()??[];return{head:["attempt","tick","travel_m","force_n","lateral_n"],columns:[t.flatMap(e=>e.rows.map(()=>e.attempt)),...["tick","travel","force","lateral"].map(e=>t.flatMap(n=>n.rows.map(s=>s[e])))]}}}function $v(i,t){if(i===null||t===null||i===t)return O.scores.dash;if(i===0)return"";const e=(t-i)/Math.abs(i);return`${e>0?"+":""}${O.units.percent(e)}`}const Ed=4;class Zv{constructor(t){this.store=t,this.content=tt("div",{class:"paper"}),this.root=Ns("report",O.report.heading,"report",tt("div",{class:"panel-tools"},$e(O.report.print,()=>window.print(),{class:"primary"})),this.content),t.on(["view","scores","marks","hello"],()=>this.show()),window.addEventListener("beforeprint",()=>this.draw())}show(){this.store.view==="report"&&this.draw()}draw(){const{hello:t,scores:e,allMarks:n}=this.store,s=new Date().toLocaleString("en-GB",{dateStyle:"long",timeStyle:"short"}),r=[t?.scene??"",O.report.made(s),O.report.version(t?.version??"")];this.content.replaceChildren(tt("p",{class:"report-head"},r.join(" · ")),...e.length>0?this.attempts(e):[tt("p",{class:"empty"},O.report.none)],...n.length>0?[tt("h3",{},O.report.marks),tt("ol",{},...n.map(o=>tt("li",{},r_(this.store,o))))]:[],tt("p",{class:"signature"},O.report.signature))}attempts(t){const e=[];for(let n=0;n<t.length;n+=Ed)e.push(this.attemptTable(t.slice(n,n+Ed)));return[tt("h3",{},O.report.attempts),...e,tt("h3",{},O.report.curves),...t.filter(n=>n.rows.length>1).map(n=>this.curve(n)),...t.filter(n=>n.targets.length>0).map(n=>this.targets(n))]}attemptTable(t){const e=Al(t[0]).map(([o])=>o),n=t.map(o=>Al(o).map(([,a])=>a)),s=[[O.scores.lines.trainee,...t.map(o=>o.trainee||O.scores.dash)],[O.scores.lines.began,...t.map(o=>o.began.replace("T"," ")||O.scores.dash)],...e.map((o,a)=>[o,...n.map(l=>l[a])]),[O.scores.lines.recording,...t.map(o=>o.recording||O.scores.notKept)]],r=["",...t.map(o=>O.scores.attempt(o.attempt))];return tt("div",{class:"wide"},_l(r,s))}curve(t){const e=e_(Rv(t,this.store.period));return e.setAttribute("role","img"),e.setAttribute("aria-label",`${O.report.curves}: ${ia(t)}`),tt("figure",{},e)}targets(t){const{kinds:e,yes:n,no:s}=O.report,r=t.targets.map(a=>[a.name,a.forbidden?e.forbidden:e.target,O.units.mm(a.closest),a.reached?n:s]),o=[O.report.target,O.report.kind,O.report.closest,O.report.reached];return tt("div",{class:"wide"},_l(o,r,`${O.report.targets}: ${ia(t)}`))}}function Kv(i){const t=i.map(({y:n})=>n),e=i.map((n,s)=>s).sort((n,s)=>i[n].y-i[s].y);return e.forEach((n,s)=>{const r=i[n];for(const o of e.slice(0,s).sort((a,l)=>t[a]-t[l])){const a=i[o],l=r.x>=a.x+a.width||a.x>=r.x+r.width,c=t[n]>=t[o]+a.height||t[o]>=t[n]+r.height;!l&&!c&&(t[n]=t[o]+a.height)}}),t}/**
 * @license
 * Copyright 2010-2024 Three.js Authors
 * SPDX-License-Identifier: MIT
 */const Ou="170",so={ROTATE:0,DOLLY:1,PAN:2},eo={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},Jv=0,Td=1,Qv=2,o_=1,tx=2,Ji=3,Vi=0,Cn=1,ui=2,ps=0,ro=1,Ad=2,Rd=3,Pd=4,ex=5,or=100,nx=101,ix=102,sx=103,rx=104,ox=200,ax=201,lx=202,cx=203,Ah=204,Rh=205,hx=206,ux=207,fx=208,dx=209,px=210,mx=211,_x=212,gx=213,bx=214,Ph=0,Ch=1,Lh=2,mo=3,Ih=4,Fh=5,Dh=6,Uh=7,ku=0,vx=1,xx=2,Is=0,Mx=1,yx=2,Sx=3,wx=4,Ex=5,Tx=6,Ax=7,a_=300,_o=301,go=302,Nh=303,Oh=304,Gl=306,kh=1e3,lr=1001,Bh=1002,Ln=1003,Rx=1004,ya=1005,Ei=1006,yc=1007,cr=1008,_s=1009,l_=1010,Bu=1011,sa=1012,Wl=1013,mr=1014,Ti=1015,oa=1016,zu=1017,Vu=1018,bo=1020,c_=35902,h_=1021,u_=1022,Ai=1023,f_=1024,d_=1025,oo=1026,vo=1027,Hu=1028,Gu=1029,p_=1030,Wu=1031,Xl=1033,nl=33776,il=33777,sl=33778,rl=33779,zh=35840,Vh=35841,Hh=35842,Gh=35843,Wh=36196,Xh=37492,Yh=37496,qh=37808,jh=37809,$h=37810,Zh=37811,Kh=37812,Jh=37813,Qh=37814,tu=37815,eu=37816,nu=37817,iu=37818,su=37819,ru=37820,ou=37821,ol=36492,au=36494,lu=36495,m_=36283,cu=36284,hu=36285,uu=36286,Px=3200,Cx=3201,Lx=0,Ix=1,Ls="",ci="srgb",br="srgb-linear",Yl="linear",Ae="srgb",Dr=7680,Fx=7681,Dx=34055,Ux=34056,Nx=517,Cd=519,Ox=512,kx=513,Bx=514,__=515,zx=516,Vx=517,Hx=518,Gx=519,Ld=35044,Id=35048,xo="300 es",hs=2e3,Rl=2001;class vr{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});const n=this._listeners;n[t]===void 0&&(n[t]=[]),n[t].indexOf(e)===-1&&n[t].push(e)}hasEventListener(t,e){if(this._listeners===void 0)return!1;const n=this._listeners;return n[t]!==void 0&&n[t].indexOf(e)!==-1}removeEventListener(t,e){if(this._listeners===void 0)return;const s=this._listeners[t];if(s!==void 0){const r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){if(this._listeners===void 0)return;const n=this._listeners[t.type];if(n!==void 0){t.target=this;const s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,t);t.target=null}}}const En=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],al=Math.PI/180,fu=180/Math.PI;function aa(){const i=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(En[i&255]+En[i>>8&255]+En[i>>16&255]+En[i>>24&255]+"-"+En[t&255]+En[t>>8&255]+"-"+En[t>>16&15|64]+En[t>>24&255]+"-"+En[e&63|128]+En[e>>8&255]+"-"+En[e>>16&255]+En[e>>24&255]+En[n&255]+En[n>>8&255]+En[n>>16&255]+En[n>>24&255]).toLowerCase()}function Rn(i,t,e){return Math.max(t,Math.min(e,i))}function Wx(i,t){return(i%t+t)%t}function Sc(i,t,e){return(1-e)*i+e*t}function Oo(i,t){switch(t.constructor){case Float32Array:return i;case Uint32Array:return i/4294967295;case Uint16Array:return i/65535;case Uint8Array:return i/255;case Int32Array:return Math.max(i/2147483647,-1);case Int16Array:return Math.max(i/32767,-1);case Int8Array:return Math.max(i/127,-1);default:throw new Error("Invalid component type.")}}function Gn(i,t){switch(t.constructor){case Float32Array:return i;case Uint32Array:return Math.round(i*4294967295);case Uint16Array:return Math.round(i*65535);case Uint8Array:return Math.round(i*255);case Int32Array:return Math.round(i*2147483647);case Int16Array:return Math.round(i*32767);case Int8Array:return Math.round(i*127);default:throw new Error("Invalid component type.")}}const Xx={DEG2RAD:al};class $t{constructor(t=0,e=0){$t.prototype.isVector2=!0,this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){const e=this.x,n=this.y,s=t.elements;return this.x=s[0]*e+s[3]*n+s[6],this.y=s[1]*e+s[4]*n+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this}clampLength(t,e){const n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){const e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;const n=this.dot(t)/e;return Math.acos(Rn(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){const e=this.x-t.x,n=this.y-t.y;return e*e+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){const n=Math.cos(e),s=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*n-o*s+t.x,this.y=r*s+o*n+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}}class te{constructor(t,e,n,s,r,o,a,l,c){te.prototype.isMatrix3=!0,this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c)}set(t,e,n,s,r,o,a,l,c){const h=this.elements;return h[0]=t,h[1]=s,h[2]=a,h[3]=e,h[4]=r,h[5]=l,h[6]=n,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){const e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],this}extractBasis(t,e,n){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(t){const e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){const n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],h=n[4],f=n[7],u=n[2],p=n[5],_=n[8],b=s[0],m=s[3],d=s[6],M=s[1],w=s[4],v=s[7],U=s[2],P=s[5],L=s[8];return r[0]=o*b+a*M+l*U,r[3]=o*m+a*w+l*P,r[6]=o*d+a*v+l*L,r[1]=c*b+h*M+f*U,r[4]=c*m+h*w+f*P,r[7]=c*d+h*v+f*L,r[2]=u*b+p*M+_*U,r[5]=u*m+p*w+_*P,r[8]=u*d+p*v+_*L,this}multiplyScalar(t){const e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){const t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8];return e*o*h-e*a*c-n*r*h+n*a*l+s*r*c-s*o*l}invert(){const t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],f=h*o-a*c,u=a*l-h*r,p=c*r-o*l,_=e*f+n*u+s*p;if(_===0)return this.set(0,0,0,0,0,0,0,0,0);const b=1/_;return t[0]=f*b,t[1]=(s*c-h*n)*b,t[2]=(a*n-s*o)*b,t[3]=u*b,t[4]=(h*e-s*l)*b,t[5]=(s*r-a*e)*b,t[6]=p*b,t[7]=(n*l-c*e)*b,t[8]=(o*e-n*r)*b,this}transpose(){let t;const e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){const e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,n,s,r,o,a){const l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+t,-s*c,s*l,-s*(-c*o+l*a)+a+e,0,0,1),this}scale(t,e){return this.premultiply(wc.makeScale(t,e)),this}rotate(t){return this.premultiply(wc.makeRotation(-t)),this}translate(t,e){return this.premultiply(wc.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){const e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,n,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){const e=this.elements,n=t.elements;for(let s=0;s<9;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<9;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){const n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t}clone(){return new this.constructor().fromArray(this.elements)}}const wc=new te;function g_(i){for(let t=i.length-1;t>=0;--t)if(i[t]>=65535)return!0;return!1}function Pl(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function Yx(){const i=Pl("canvas");return i.style.display="block",i}const Fd={};function $o(i){i in Fd||(Fd[i]=!0,console.warn(i))}function qx(i,t,e){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(t,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:n()}}setTimeout(r,e)})}function jx(i){const t=i.elements;t[2]=.5*t[2]+.5*t[3],t[6]=.5*t[6]+.5*t[7],t[10]=.5*t[10]+.5*t[11],t[14]=.5*t[14]+.5*t[15]}function $x(i){const t=i.elements;t[11]===-1?(t[10]=-t[10]-1,t[14]=-t[14]):(t[10]=-t[10],t[14]=-t[14]+1)}const fe={enabled:!0,workingColorSpace:br,spaces:{},convert:function(i,t,e){return this.enabled===!1||t===e||!t||!e||(this.spaces[t].transfer===Ae&&(i.r=ms(i.r),i.g=ms(i.g),i.b=ms(i.b)),this.spaces[t].primaries!==this.spaces[e].primaries&&(i.applyMatrix3(this.spaces[t].toXYZ),i.applyMatrix3(this.spaces[e].fromXYZ)),this.spaces[e].transfer===Ae&&(i.r=ao(i.r),i.g=ao(i.g),i.b=ao(i.b))),i},fromWorkingColorSpace:function(i,t){return this.convert(i,this.workingColorSpace,t)},toWorkingColorSpace:function(i,t){return this.convert(i,t,this.workingColorSpace)},getPrimaries:function(i){return this.spaces[i].primaries},getTransfer:function(i){return i===Ls?Yl:this.spaces[i].transfer},getLuminanceCoefficients:function(i,t=this.workingColorSpace){return i.fromArray(this.spaces[t].luminanceCoefficients)},define:function(i){Object.assign(this.spaces,i)},_getMatrix:function(i,t,e){return i.copy(this.spaces[t].toXYZ).multiply(this.spaces[e].fromXYZ)},_getDrawingBufferColorSpace:function(i){return this.spaces[i].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(i=this.workingColorSpace){return this.spaces[i].workingColorSpaceConfig.unpackColorSpace}};function ms(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function ao(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}const Dd=[.64,.33,.3,.6,.15,.06],Ud=[.2126,.7152,.0722],Nd=[.3127,.329],Od=new te().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),kd=new te().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);fe.define({[br]:{primaries:Dd,whitePoint:Nd,transfer:Yl,toXYZ:Od,fromXYZ:kd,luminanceCoefficients:Ud,workingColorSpaceConfig:{unpackColorSpace:ci},outputColorSpaceConfig:{drawingBufferColorSpace:ci}},[ci]:{primaries:Dd,whitePoint:Nd,transfer:Ae,toXYZ:Od,fromXYZ:kd,luminanceCoefficients:Ud,outputColorSpaceConfig:{drawingBufferColorSpace:ci}}});let Ur;class Zx{static getDataURL(t){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let e;if(t instanceof HTMLCanvasElement)e=t;else{Ur===void 0&&(Ur=Pl("canvas")),Ur.width=t.width,Ur.height=t.height;const n=Ur.getContext("2d");t instanceof ImageData?n.putImageData(t,0,0):n.drawImage(t,0,0,t.width,t.height),e=Ur}return e.width>2048||e.height>2048?(console.warn("THREE.ImageUtils.getDataURL: Image converted to jpg for performance reasons",t),e.toDataURL("image/jpeg",.6)):e.toDataURL("image/png")}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){const e=Pl("canvas");e.width=t.width,e.height=t.height;const n=e.getContext("2d");n.drawImage(t,0,0,t.width,t.height);const s=n.getImageData(0,0,t.width,t.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=ms(r[o]/255)*255;return n.putImageData(s,0,0),e}else if(t.data){const e=t.data.slice(0);for(let n=0;n<e.length;n++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[n]=Math.floor(ms(e[n]/255)*255):e[n]=ms(e[n]);return{data:e,width:t.width,height:t.height}}else return console.warn("THREE.ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}}let Kx=0;class b_{constructor(t=null){this.isSource=!0,Object.defineProperty(this,"id",{value:Kx++}),this.uuid=aa(),this.data=t,this.dataReady=!0,this.version=0}set needsUpdate(t){t===!0&&this.version++}toJSON(t){const e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];const n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(Ec(s[o].image)):r.push(Ec(s[o]))}else r=Ec(s);n.url=r}return e||(t.images[this.uuid]=n),n}}function Ec(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?Zx.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(console.warn("THREE.Texture: Unable to serialize Texture."),{})}let Jx=0;class zn extends vr{constructor(t=zn.DEFAULT_IMAGE,e=zn.DEFAULT_MAPPING,n=lr,s=lr,r=Ei,o=cr,a=Ai,l=_s,c=zn.DEFAULT_ANISOTROPY,h=Ls){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:Jx++}),this.uuid=aa(),this.name="",this.source=new b_(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new $t(0,0),this.repeat=new $t(1,1),this.center=new $t(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new te,this.generateMipmaps=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.version=0,this.onUpdate=null,this.isRenderTargetTexture=!1,this.pmremVersion=0}get image(){return this.source.data}set image(t=null){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}toJSON(t){const e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];const n={metadata:{version:4.6,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),e||(t.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==a_)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case kh:t.x=t.x-Math.floor(t.x);break;case lr:t.x=t.x<0?0:1;break;case Bh:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case kh:t.y=t.y-Math.floor(t.y);break;case lr:t.y=t.y<0?0:1;break;case Bh:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}}zn.DEFAULT_IMAGE=null;zn.DEFAULT_MAPPING=a_;zn.DEFAULT_ANISOTROPY=1;class He{constructor(t=0,e=0,n=0,s=1){He.prototype.isVector4=!0,this.x=t,this.y=e,this.z=n,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,n,s){return this.x=t,this.y=e,this.z=n,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){const e=this.x,n=this.y,s=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*e+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*e+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*e+o[7]*n+o[11]*s+o[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);const e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,n,s,r;const l=t.elements,c=l[0],h=l[4],f=l[8],u=l[1],p=l[5],_=l[9],b=l[2],m=l[6],d=l[10];if(Math.abs(h-u)<.01&&Math.abs(f-b)<.01&&Math.abs(_-m)<.01){if(Math.abs(h+u)<.1&&Math.abs(f+b)<.1&&Math.abs(_+m)<.1&&Math.abs(c+p+d-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;const w=(c+1)/2,v=(p+1)/2,U=(d+1)/2,P=(h+u)/4,L=(f+b)/4,F=(_+m)/4;return w>v&&w>U?w<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(w),s=P/n,r=L/n):v>U?v<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(v),n=P/s,r=F/s):U<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(U),n=L/r,s=F/r),this.set(n,s,r,e),this}let M=Math.sqrt((m-_)*(m-_)+(f-b)*(f-b)+(u-h)*(u-h));return Math.abs(M)<.001&&(M=1),this.x=(m-_)/M,this.y=(f-b)/M,this.z=(u-h)/M,this.w=Math.acos((c+p+d-1)/2),this}setFromMatrixPosition(t){const e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this.z=Math.max(t.z,Math.min(e.z,this.z)),this.w=Math.max(t.w,Math.min(e.w,this.w)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this.z=Math.max(t,Math.min(e,this.z)),this.w=Math.max(t,Math.min(e,this.w)),this}clampLength(t,e){const n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this.w=t.w+(e.w-t.w)*n,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}}class Qx extends vr{constructor(t=1,e=1,n={}){super(),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=1,this.scissor=new He(0,0,t,e),this.scissorTest=!1,this.viewport=new He(0,0,t,e);const s={width:t,height:e,depth:1};n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Ei,depthBuffer:!0,stencilBuffer:!1,resolveDepthBuffer:!0,resolveStencilBuffer:!0,depthTexture:null,samples:0,count:1},n);const r=new zn(s,n.mapping,n.wrapS,n.wrapT,n.magFilter,n.minFilter,n.format,n.type,n.anisotropy,n.colorSpace);r.flipY=!1,r.generateMipmaps=n.generateMipmaps,r.internalFormat=n.internalFormat,this.textures=[];const o=n.count;for(let a=0;a<o;a++)this.textures[a]=r.clone(),this.textures[a].isRenderTargetTexture=!0;this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.depthTexture=n.depthTexture,this.samples=n.samples}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}setSize(t,e,n=1){if(this.width!==t||this.height!==e||this.depth!==n){this.width=t,this.height=e,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=n;this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let n=0,s=t.textures.length;n<s;n++)this.textures[n]=t.textures[n].clone(),this.textures[n].isRenderTargetTexture=!0;const e=Object.assign({},t.texture.image);return this.texture.source=new b_(e),this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,t.depthTexture!==null&&(this.depthTexture=t.depthTexture.clone()),this.samples=t.samples,this}dispose(){this.dispatchEvent({type:"dispose"})}}class Ds extends Qx{constructor(t=1,e=1,n={}){super(t,e,n),this.isWebGLRenderTarget=!0}}class v_ extends zn{constructor(t=null,e=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=Ln,this.minFilter=Ln,this.wrapR=lr,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}}class tM extends zn{constructor(t=null,e=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=Ln,this.minFilter=Ln,this.wrapR=lr,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}}class Us{constructor(t=0,e=0,n=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=n,this._w=s}static slerpFlat(t,e,n,s,r,o,a){let l=n[s+0],c=n[s+1],h=n[s+2],f=n[s+3];const u=r[o+0],p=r[o+1],_=r[o+2],b=r[o+3];if(a===0){t[e+0]=l,t[e+1]=c,t[e+2]=h,t[e+3]=f;return}if(a===1){t[e+0]=u,t[e+1]=p,t[e+2]=_,t[e+3]=b;return}if(f!==b||l!==u||c!==p||h!==_){let m=1-a;const d=l*u+c*p+h*_+f*b,M=d>=0?1:-1,w=1-d*d;if(w>Number.EPSILON){const U=Math.sqrt(w),P=Math.atan2(U,d*M);m=Math.sin(m*P)/U,a=Math.sin(a*P)/U}const v=a*M;if(l=l*m+u*v,c=c*m+p*v,h=h*m+_*v,f=f*m+b*v,m===1-a){const U=1/Math.sqrt(l*l+c*c+h*h+f*f);l*=U,c*=U,h*=U,f*=U}}t[e]=l,t[e+1]=c,t[e+2]=h,t[e+3]=f}static multiplyQuaternionsFlat(t,e,n,s,r,o){const a=n[s],l=n[s+1],c=n[s+2],h=n[s+3],f=r[o],u=r[o+1],p=r[o+2],_=r[o+3];return t[e]=a*_+h*f+l*p-c*u,t[e+1]=l*_+h*u+c*f-a*p,t[e+2]=c*_+h*p+a*u-l*f,t[e+3]=h*_-a*f-l*u-c*p,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,n,s){return this._x=t,this._y=e,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){const n=t._x,s=t._y,r=t._z,o=t._order,a=Math.cos,l=Math.sin,c=a(n/2),h=a(s/2),f=a(r/2),u=l(n/2),p=l(s/2),_=l(r/2);switch(o){case"XYZ":this._x=u*h*f+c*p*_,this._y=c*p*f-u*h*_,this._z=c*h*_+u*p*f,this._w=c*h*f-u*p*_;break;case"YXZ":this._x=u*h*f+c*p*_,this._y=c*p*f-u*h*_,this._z=c*h*_-u*p*f,this._w=c*h*f+u*p*_;break;case"ZXY":this._x=u*h*f-c*p*_,this._y=c*p*f+u*h*_,this._z=c*h*_+u*p*f,this._w=c*h*f-u*p*_;break;case"ZYX":this._x=u*h*f-c*p*_,this._y=c*p*f+u*h*_,this._z=c*h*_-u*p*f,this._w=c*h*f+u*p*_;break;case"YZX":this._x=u*h*f+c*p*_,this._y=c*p*f+u*h*_,this._z=c*h*_-u*p*f,this._w=c*h*f-u*p*_;break;case"XZY":this._x=u*h*f-c*p*_,this._y=c*p*f-u*h*_,this._z=c*h*_+u*p*f,this._w=c*h*f+u*p*_;break;default:console.warn("THREE.Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){const n=e/2,s=Math.sin(n);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(t){const e=t.elements,n=e[0],s=e[4],r=e[8],o=e[1],a=e[5],l=e[9],c=e[2],h=e[6],f=e[10],u=n+a+f;if(u>0){const p=.5/Math.sqrt(u+1);this._w=.25/p,this._x=(h-l)*p,this._y=(r-c)*p,this._z=(o-s)*p}else if(n>a&&n>f){const p=2*Math.sqrt(1+n-a-f);this._w=(h-l)/p,this._x=.25*p,this._y=(s+o)/p,this._z=(r+c)/p}else if(a>f){const p=2*Math.sqrt(1+a-n-f);this._w=(r-c)/p,this._x=(s+o)/p,this._y=.25*p,this._z=(l+h)/p}else{const p=2*Math.sqrt(1+f-n-a);this._w=(o-s)/p,this._x=(r+c)/p,this._y=(l+h)/p,this._z=.25*p}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let n=t.dot(e)+1;return n<Number.EPSILON?(n=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=n):(this._x=0,this._y=-t.z,this._z=t.y,this._w=n)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=n),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(Rn(this.dot(t),-1,1)))}rotateTowards(t,e){const n=this.angleTo(t);if(n===0)return this;const s=Math.min(1,e/n);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){const n=t._x,s=t._y,r=t._z,o=t._w,a=e._x,l=e._y,c=e._z,h=e._w;return this._x=n*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-n*c,this._z=r*h+o*c+n*l-s*a,this._w=o*h-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(t,e){if(e===0)return this;if(e===1)return this.copy(t);const n=this._x,s=this._y,r=this._z,o=this._w;let a=o*t._w+n*t._x+s*t._y+r*t._z;if(a<0?(this._w=-t._w,this._x=-t._x,this._y=-t._y,this._z=-t._z,a=-a):this.copy(t),a>=1)return this._w=o,this._x=n,this._y=s,this._z=r,this;const l=1-a*a;if(l<=Number.EPSILON){const p=1-e;return this._w=p*o+e*this._w,this._x=p*n+e*this._x,this._y=p*s+e*this._y,this._z=p*r+e*this._z,this.normalize(),this}const c=Math.sqrt(l),h=Math.atan2(c,a),f=Math.sin((1-e)*h)/c,u=Math.sin(e*h)/c;return this._w=o*f+this._w*u,this._x=n*f+this._x*u,this._y=s*f+this._y*u,this._z=r*f+this._z*u,this._onChangeCallback(),this}slerpQuaternions(t,e,n){return this.copy(t).slerp(e,n)}random(){const t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}}class D{constructor(t=0,e=0,n=0){D.prototype.isVector3=!0,this.x=t,this.y=e,this.z=n}set(t,e,n){return n===void 0&&(n=this.z),this.x=t,this.y=e,this.z=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(Bd.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(Bd.setFromAxisAngle(t,e))}applyMatrix3(t){const e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*n+r[6]*s,this.y=r[1]*e+r[4]*n+r[7]*s,this.z=r[2]*e+r[5]*n+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){const e=this.x,n=this.y,s=this.z,r=t.elements,o=1/(r[3]*e+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*e+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*e+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(t){const e=this.x,n=this.y,s=this.z,r=t.x,o=t.y,a=t.z,l=t.w,c=2*(o*s-a*n),h=2*(a*e-r*s),f=2*(r*n-o*e);return this.x=e+l*c+o*f-a*h,this.y=n+l*h+a*c-r*f,this.z=s+l*f+r*h-o*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){const e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*n+r[8]*s,this.y=r[1]*e+r[5]*n+r[9]*s,this.z=r[2]*e+r[6]*n+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this.z=Math.max(t.z,Math.min(e.z,this.z)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this.z=Math.max(t,Math.min(e,this.z)),this}clampLength(t,e){const n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){const n=t.x,s=t.y,r=t.z,o=e.x,a=e.y,l=e.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(t){const e=t.lengthSq();if(e===0)return this.set(0,0,0);const n=t.dot(this)/e;return this.copy(t).multiplyScalar(n)}projectOnPlane(t){return Tc.copy(this).projectOnVector(t),this.sub(Tc)}reflect(t){return this.sub(Tc.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){const e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;const n=this.dot(t)/e;return Math.acos(Rn(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){const e=this.x-t.x,n=this.y-t.y,s=this.z-t.z;return e*e+n*n+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,n){const s=Math.sin(e)*t;return this.x=s*Math.sin(n),this.y=Math.cos(e)*t,this.z=s*Math.cos(n),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,n){return this.x=t*Math.sin(e),this.y=n,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){const e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){const e=this.setFromMatrixColumn(t,0).length(),n=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=n,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){const t=Math.random()*Math.PI*2,e=Math.random()*2-1,n=Math.sqrt(1-e*e);return this.x=n*Math.cos(t),this.y=e,this.z=n*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}}const Tc=new D,Bd=new Us;class Os{constructor(t=new D(1/0,1/0,1/0),e=new D(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e+=3)this.expandByPoint(_i.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,n=t.count;e<n;e++)this.expandByPoint(_i.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){const n=_i.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(n),this.max.copy(t).add(n),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);const n=t.geometry;if(n!==void 0){const r=n.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,_i):_i.fromBufferAttribute(r,o),_i.applyMatrix4(t.matrixWorld),this.expandByPoint(_i);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),Sa.copy(t.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),Sa.copy(n.boundingBox)),Sa.applyMatrix4(t.matrixWorld),this.union(Sa)}const s=t.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,_i),_i.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,n;return t.normal.x>0?(e=t.normal.x*this.min.x,n=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,n=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,n+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,n+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,n+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,n+=t.normal.z*this.min.z),e<=-t.constant&&n>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(ko),wa.subVectors(this.max,ko),Nr.subVectors(t.a,ko),Or.subVectors(t.b,ko),kr.subVectors(t.c,ko),Ss.subVectors(Or,Nr),ws.subVectors(kr,Or),Ws.subVectors(Nr,kr);let e=[0,-Ss.z,Ss.y,0,-ws.z,ws.y,0,-Ws.z,Ws.y,Ss.z,0,-Ss.x,ws.z,0,-ws.x,Ws.z,0,-Ws.x,-Ss.y,Ss.x,0,-ws.y,ws.x,0,-Ws.y,Ws.x,0];return!Ac(e,Nr,Or,kr,wa)||(e=[1,0,0,0,1,0,0,0,1],!Ac(e,Nr,Or,kr,wa))?!1:(Ea.crossVectors(Ss,ws),e=[Ea.x,Ea.y,Ea.z],Ac(e,Nr,Or,kr,wa))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,_i).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(_i).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(qi[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),qi[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),qi[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),qi[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),qi[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),qi[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),qi[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),qi[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(qi),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}}const qi=[new D,new D,new D,new D,new D,new D,new D,new D],_i=new D,Sa=new Os,Nr=new D,Or=new D,kr=new D,Ss=new D,ws=new D,Ws=new D,ko=new D,wa=new D,Ea=new D,Xs=new D;function Ac(i,t,e,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){Xs.fromArray(i,r);const a=s.x*Math.abs(Xs.x)+s.y*Math.abs(Xs.y)+s.z*Math.abs(Xs.z),l=t.dot(Xs),c=e.dot(Xs),h=n.dot(Xs);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}const eM=new Os,Bo=new D,Rc=new D;class xr{constructor(t=new D,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){const n=this.center;e!==void 0?n.copy(e):eM.setFromPoints(t).getCenter(n);let s=0;for(let r=0,o=t.length;r<o;r++)s=Math.max(s,n.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){const e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){const n=this.center.distanceToSquared(t);return e.copy(t),n>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;Bo.subVectors(t,this.center);const e=Bo.lengthSq();if(e>this.radius*this.radius){const n=Math.sqrt(e),s=(n-this.radius)*.5;this.center.addScaledVector(Bo,s/n),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(Rc.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(Bo.copy(t.center).add(Rc)),this.expandByPoint(Bo.copy(t.center).sub(Rc))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}}const ji=new D,Pc=new D,Ta=new D,Es=new D,Cc=new D,Aa=new D,Lc=new D;class ql{constructor(t=new D,e=new D(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,ji)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);const n=e.dot(this.direction);return n<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){const e=ji.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(ji.copy(this.origin).addScaledVector(this.direction,e),ji.distanceToSquared(t))}distanceSqToSegment(t,e,n,s){Pc.copy(t).add(e).multiplyScalar(.5),Ta.copy(e).sub(t).normalize(),Es.copy(this.origin).sub(Pc);const r=t.distanceTo(e)*.5,o=-this.direction.dot(Ta),a=Es.dot(this.direction),l=-Es.dot(Ta),c=Es.lengthSq(),h=Math.abs(1-o*o);let f,u,p,_;if(h>0)if(f=o*l-a,u=o*a-l,_=r*h,f>=0)if(u>=-_)if(u<=_){const b=1/h;f*=b,u*=b,p=f*(f+o*u+2*a)+u*(o*f+u+2*l)+c}else u=r,f=Math.max(0,-(o*u+a)),p=-f*f+u*(u+2*l)+c;else u=-r,f=Math.max(0,-(o*u+a)),p=-f*f+u*(u+2*l)+c;else u<=-_?(f=Math.max(0,-(-o*r+a)),u=f>0?-r:Math.min(Math.max(-r,-l),r),p=-f*f+u*(u+2*l)+c):u<=_?(f=0,u=Math.min(Math.max(-r,-l),r),p=u*(u+2*l)+c):(f=Math.max(0,-(o*r+a)),u=f>0?r:Math.min(Math.max(-r,-l),r),p=-f*f+u*(u+2*l)+c);else u=o>0?-r:r,f=Math.max(0,-(o*u+a)),p=-f*f+u*(u+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,f),s&&s.copy(Pc).addScaledVector(Ta,u),p}intersectSphere(t,e){ji.subVectors(t.center,this.origin);const n=ji.dot(this.direction),s=ji.dot(ji)-n*n,r=t.radius*t.radius;if(s>r)return null;const o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,e):this.at(a,e)}intersectsSphere(t){return this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){const e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;const n=-(this.origin.dot(t.normal)+t.constant)/e;return n>=0?n:null}intersectPlane(t,e){const n=this.distanceToPlane(t);return n===null?null:this.at(n,e)}intersectsPlane(t){const e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let n,s,r,o,a,l;const c=1/this.direction.x,h=1/this.direction.y,f=1/this.direction.z,u=this.origin;return c>=0?(n=(t.min.x-u.x)*c,s=(t.max.x-u.x)*c):(n=(t.max.x-u.x)*c,s=(t.min.x-u.x)*c),h>=0?(r=(t.min.y-u.y)*h,o=(t.max.y-u.y)*h):(r=(t.max.y-u.y)*h,o=(t.min.y-u.y)*h),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),f>=0?(a=(t.min.z-u.z)*f,l=(t.max.z-u.z)*f):(a=(t.max.z-u.z)*f,l=(t.min.z-u.z)*f),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,e)}intersectsBox(t){return this.intersectBox(t,ji)!==null}intersectTriangle(t,e,n,s,r){Cc.subVectors(e,t),Aa.subVectors(n,t),Lc.crossVectors(Cc,Aa);let o=this.direction.dot(Lc),a;if(o>0){if(s)return null;a=1}else if(o<0)a=-1,o=-o;else return null;Es.subVectors(this.origin,t);const l=a*this.direction.dot(Aa.crossVectors(Es,Aa));if(l<0)return null;const c=a*this.direction.dot(Cc.cross(Es));if(c<0||l+c>o)return null;const h=-a*Es.dot(Lc);return h<0?null:this.at(h/o,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}}class Pe{constructor(t,e,n,s,r,o,a,l,c,h,f,u,p,_,b,m){Pe.prototype.isMatrix4=!0,this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c,h,f,u,p,_,b,m)}set(t,e,n,s,r,o,a,l,c,h,f,u,p,_,b,m){const d=this.elements;return d[0]=t,d[4]=e,d[8]=n,d[12]=s,d[1]=r,d[5]=o,d[9]=a,d[13]=l,d[2]=c,d[6]=h,d[10]=f,d[14]=u,d[3]=p,d[7]=_,d[11]=b,d[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new Pe().fromArray(this.elements)}copy(t){const e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],e[9]=n[9],e[10]=n[10],e[11]=n[11],e[12]=n[12],e[13]=n[13],e[14]=n[14],e[15]=n[15],this}copyPosition(t){const e=this.elements,n=t.elements;return e[12]=n[12],e[13]=n[13],e[14]=n[14],this}setFromMatrix3(t){const e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,n){return t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this}makeBasis(t,e,n){return this.set(t.x,e.x,n.x,0,t.y,e.y,n.y,0,t.z,e.z,n.z,0,0,0,0,1),this}extractRotation(t){const e=this.elements,n=t.elements,s=1/Br.setFromMatrixColumn(t,0).length(),r=1/Br.setFromMatrixColumn(t,1).length(),o=1/Br.setFromMatrixColumn(t,2).length();return e[0]=n[0]*s,e[1]=n[1]*s,e[2]=n[2]*s,e[3]=0,e[4]=n[4]*r,e[5]=n[5]*r,e[6]=n[6]*r,e[7]=0,e[8]=n[8]*o,e[9]=n[9]*o,e[10]=n[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){const e=this.elements,n=t.x,s=t.y,r=t.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),f=Math.sin(r);if(t.order==="XYZ"){const u=o*h,p=o*f,_=a*h,b=a*f;e[0]=l*h,e[4]=-l*f,e[8]=c,e[1]=p+_*c,e[5]=u-b*c,e[9]=-a*l,e[2]=b-u*c,e[6]=_+p*c,e[10]=o*l}else if(t.order==="YXZ"){const u=l*h,p=l*f,_=c*h,b=c*f;e[0]=u+b*a,e[4]=_*a-p,e[8]=o*c,e[1]=o*f,e[5]=o*h,e[9]=-a,e[2]=p*a-_,e[6]=b+u*a,e[10]=o*l}else if(t.order==="ZXY"){const u=l*h,p=l*f,_=c*h,b=c*f;e[0]=u-b*a,e[4]=-o*f,e[8]=_+p*a,e[1]=p+_*a,e[5]=o*h,e[9]=b-u*a,e[2]=-o*c,e[6]=a,e[10]=o*l}else if(t.order==="ZYX"){const u=o*h,p=o*f,_=a*h,b=a*f;e[0]=l*h,e[4]=_*c-p,e[8]=u*c+b,e[1]=l*f,e[5]=b*c+u,e[9]=p*c-_,e[2]=-c,e[6]=a*l,e[10]=o*l}else if(t.order==="YZX"){const u=o*l,p=o*c,_=a*l,b=a*c;e[0]=l*h,e[4]=b-u*f,e[8]=_*f+p,e[1]=f,e[5]=o*h,e[9]=-a*h,e[2]=-c*h,e[6]=p*f+_,e[10]=u-b*f}else if(t.order==="XZY"){const u=o*l,p=o*c,_=a*l,b=a*c;e[0]=l*h,e[4]=-f,e[8]=c*h,e[1]=u*f+b,e[5]=o*h,e[9]=p*f-_,e[2]=_*f-p,e[6]=a*h,e[10]=b*f+u}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(nM,t,iM)}lookAt(t,e,n){const s=this.elements;return $n.subVectors(t,e),$n.lengthSq()===0&&($n.z=1),$n.normalize(),Ts.crossVectors(n,$n),Ts.lengthSq()===0&&(Math.abs(n.z)===1?$n.x+=1e-4:$n.z+=1e-4,$n.normalize(),Ts.crossVectors(n,$n)),Ts.normalize(),Ra.crossVectors($n,Ts),s[0]=Ts.x,s[4]=Ra.x,s[8]=$n.x,s[1]=Ts.y,s[5]=Ra.y,s[9]=$n.y,s[2]=Ts.z,s[6]=Ra.z,s[10]=$n.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){const n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],h=n[1],f=n[5],u=n[9],p=n[13],_=n[2],b=n[6],m=n[10],d=n[14],M=n[3],w=n[7],v=n[11],U=n[15],P=s[0],L=s[4],F=s[8],S=s[12],x=s[1],A=s[5],V=s[9],N=s[13],Y=s[2],X=s[6],J=s[10],K=s[14],et=s[3],ct=s[7],ht=s[11],_t=s[15];return r[0]=o*P+a*x+l*Y+c*et,r[4]=o*L+a*A+l*X+c*ct,r[8]=o*F+a*V+l*J+c*ht,r[12]=o*S+a*N+l*K+c*_t,r[1]=h*P+f*x+u*Y+p*et,r[5]=h*L+f*A+u*X+p*ct,r[9]=h*F+f*V+u*J+p*ht,r[13]=h*S+f*N+u*K+p*_t,r[2]=_*P+b*x+m*Y+d*et,r[6]=_*L+b*A+m*X+d*ct,r[10]=_*F+b*V+m*J+d*ht,r[14]=_*S+b*N+m*K+d*_t,r[3]=M*P+w*x+v*Y+U*et,r[7]=M*L+w*A+v*X+U*ct,r[11]=M*F+w*V+v*J+U*ht,r[15]=M*S+w*N+v*K+U*_t,this}multiplyScalar(t){const e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){const t=this.elements,e=t[0],n=t[4],s=t[8],r=t[12],o=t[1],a=t[5],l=t[9],c=t[13],h=t[2],f=t[6],u=t[10],p=t[14],_=t[3],b=t[7],m=t[11],d=t[15];return _*(+r*l*f-s*c*f-r*a*u+n*c*u+s*a*p-n*l*p)+b*(+e*l*p-e*c*u+r*o*u-s*o*p+s*c*h-r*l*h)+m*(+e*c*f-e*a*p-r*o*f+n*o*p+r*a*h-n*c*h)+d*(-s*a*h-e*l*f+e*a*u+s*o*f-n*o*u+n*l*h)}transpose(){const t=this.elements;let e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,n){const s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=n),this}invert(){const t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],f=t[9],u=t[10],p=t[11],_=t[12],b=t[13],m=t[14],d=t[15],M=f*m*c-b*u*c+b*l*p-a*m*p-f*l*d+a*u*d,w=_*u*c-h*m*c-_*l*p+o*m*p+h*l*d-o*u*d,v=h*b*c-_*f*c+_*a*p-o*b*p-h*a*d+o*f*d,U=_*f*l-h*b*l-_*a*u+o*b*u+h*a*m-o*f*m,P=e*M+n*w+s*v+r*U;if(P===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);const L=1/P;return t[0]=M*L,t[1]=(b*u*r-f*m*r-b*s*p+n*m*p+f*s*d-n*u*d)*L,t[2]=(a*m*r-b*l*r+b*s*c-n*m*c-a*s*d+n*l*d)*L,t[3]=(f*l*r-a*u*r-f*s*c+n*u*c+a*s*p-n*l*p)*L,t[4]=w*L,t[5]=(h*m*r-_*u*r+_*s*p-e*m*p-h*s*d+e*u*d)*L,t[6]=(_*l*r-o*m*r-_*s*c+e*m*c+o*s*d-e*l*d)*L,t[7]=(o*u*r-h*l*r+h*s*c-e*u*c-o*s*p+e*l*p)*L,t[8]=v*L,t[9]=(_*f*r-h*b*r-_*n*p+e*b*p+h*n*d-e*f*d)*L,t[10]=(o*b*r-_*a*r+_*n*c-e*b*c-o*n*d+e*a*d)*L,t[11]=(h*a*r-o*f*r-h*n*c+e*f*c+o*n*p-e*a*p)*L,t[12]=U*L,t[13]=(h*b*s-_*f*s+_*n*u-e*b*u-h*n*m+e*f*m)*L,t[14]=(_*a*s-o*b*s-_*n*l+e*b*l+o*n*m-e*a*m)*L,t[15]=(o*f*s-h*a*s+h*n*l-e*f*l-o*n*u+e*a*u)*L,this}scale(t){const e=this.elements,n=t.x,s=t.y,r=t.z;return e[0]*=n,e[4]*=s,e[8]*=r,e[1]*=n,e[5]*=s,e[9]*=r,e[2]*=n,e[6]*=s,e[10]*=r,e[3]*=n,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){const t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],n=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,n,s))}makeTranslation(t,e,n){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,n,0,0,0,1),this}makeRotationX(t){const e=Math.cos(t),n=Math.sin(t);return this.set(1,0,0,0,0,e,-n,0,0,n,e,0,0,0,0,1),this}makeRotationY(t){const e=Math.cos(t),n=Math.sin(t);return this.set(e,0,n,0,0,1,0,0,-n,0,e,0,0,0,0,1),this}makeRotationZ(t){const e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,0,n,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){const n=Math.cos(e),s=Math.sin(e),r=1-n,o=t.x,a=t.y,l=t.z,c=r*o,h=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+n,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(t,e,n){return this.set(t,0,0,0,0,e,0,0,0,0,n,0,0,0,0,1),this}makeShear(t,e,n,s,r,o){return this.set(1,n,r,0,t,1,o,0,e,s,1,0,0,0,0,1),this}compose(t,e,n){const s=this.elements,r=e._x,o=e._y,a=e._z,l=e._w,c=r+r,h=o+o,f=a+a,u=r*c,p=r*h,_=r*f,b=o*h,m=o*f,d=a*f,M=l*c,w=l*h,v=l*f,U=n.x,P=n.y,L=n.z;return s[0]=(1-(b+d))*U,s[1]=(p+v)*U,s[2]=(_-w)*U,s[3]=0,s[4]=(p-v)*P,s[5]=(1-(u+d))*P,s[6]=(m+M)*P,s[7]=0,s[8]=(_+w)*L,s[9]=(m-M)*L,s[10]=(1-(u+b))*L,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,n){const s=this.elements;let r=Br.set(s[0],s[1],s[2]).length();const o=Br.set(s[4],s[5],s[6]).length(),a=Br.set(s[8],s[9],s[10]).length();this.determinant()<0&&(r=-r),t.x=s[12],t.y=s[13],t.z=s[14],gi.copy(this);const c=1/r,h=1/o,f=1/a;return gi.elements[0]*=c,gi.elements[1]*=c,gi.elements[2]*=c,gi.elements[4]*=h,gi.elements[5]*=h,gi.elements[6]*=h,gi.elements[8]*=f,gi.elements[9]*=f,gi.elements[10]*=f,e.setFromRotationMatrix(gi),n.x=r,n.y=o,n.z=a,this}makePerspective(t,e,n,s,r,o,a=hs){const l=this.elements,c=2*r/(e-t),h=2*r/(n-s),f=(e+t)/(e-t),u=(n+s)/(n-s);let p,_;if(a===hs)p=-(o+r)/(o-r),_=-2*o*r/(o-r);else if(a===Rl)p=-o/(o-r),_=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return l[0]=c,l[4]=0,l[8]=f,l[12]=0,l[1]=0,l[5]=h,l[9]=u,l[13]=0,l[2]=0,l[6]=0,l[10]=p,l[14]=_,l[3]=0,l[7]=0,l[11]=-1,l[15]=0,this}makeOrthographic(t,e,n,s,r,o,a=hs){const l=this.elements,c=1/(e-t),h=1/(n-s),f=1/(o-r),u=(e+t)*c,p=(n+s)*h;let _,b;if(a===hs)_=(o+r)*f,b=-2*f;else if(a===Rl)_=r*f,b=-1*f;else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return l[0]=2*c,l[4]=0,l[8]=0,l[12]=-u,l[1]=0,l[5]=2*h,l[9]=0,l[13]=-p,l[2]=0,l[6]=0,l[10]=b,l[14]=-_,l[3]=0,l[7]=0,l[11]=0,l[15]=1,this}equals(t){const e=this.elements,n=t.elements;for(let s=0;s<16;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<16;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){const n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t[e+9]=n[9],t[e+10]=n[10],t[e+11]=n[11],t[e+12]=n[12],t[e+13]=n[13],t[e+14]=n[14],t[e+15]=n[15],t}}const Br=new D,gi=new Pe,nM=new D(0,0,0),iM=new D(1,1,1),Ts=new D,Ra=new D,$n=new D,zd=new Pe,Vd=new Us;class gs{constructor(t=0,e=0,n=0,s=gs.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=n,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,n,s=this._order){return this._x=t,this._y=e,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,n=!0){const s=t.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],f=s[2],u=s[6],p=s[10];switch(e){case"XYZ":this._y=Math.asin(Rn(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,p),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(u,c),this._z=0);break;case"YXZ":this._x=Math.asin(-Rn(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,p),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-f,r),this._z=0);break;case"ZXY":this._x=Math.asin(Rn(u,-1,1)),Math.abs(u)<.9999999?(this._y=Math.atan2(-f,p),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-Rn(f,-1,1)),Math.abs(f)<.9999999?(this._x=Math.atan2(u,p),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(Rn(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-f,r)):(this._x=0,this._y=Math.atan2(a,p));break;case"XZY":this._z=Math.asin(-Rn(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(u,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,p),this._y=0);break;default:console.warn("THREE.Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,n===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,n){return zd.makeRotationFromQuaternion(t),this.setFromRotationMatrix(zd,e,n)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return Vd.setFromEuler(this),this.setFromQuaternion(Vd,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}}gs.DEFAULT_ORDER="XYZ";class x_{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}}let sM=0;const Hd=new D,zr=new Us,$i=new Pe,Pa=new D,zo=new D,rM=new D,oM=new Us,Gd=new D(1,0,0),Wd=new D(0,1,0),Xd=new D(0,0,1),Yd={type:"added"},aM={type:"removed"},Vr={type:"childadded",child:null},Ic={type:"childremoved",child:null};class Mn extends vr{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:sM++}),this.uuid=aa(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=Mn.DEFAULT_UP.clone();const t=new D,e=new gs,n=new Us,s=new D(1,1,1);function r(){n.setFromEuler(e,!1)}function o(){e.setFromQuaternion(n,void 0,!1)}e._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Pe},normalMatrix:{value:new te}}),this.matrix=new Pe,this.matrixWorld=new Pe,this.matrixAutoUpdate=Mn.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=Mn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new x_,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.userData={}}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return zr.setFromAxisAngle(t,e),this.quaternion.multiply(zr),this}rotateOnWorldAxis(t,e){return zr.setFromAxisAngle(t,e),this.quaternion.premultiply(zr),this}rotateX(t){return this.rotateOnAxis(Gd,t)}rotateY(t){return this.rotateOnAxis(Wd,t)}rotateZ(t){return this.rotateOnAxis(Xd,t)}translateOnAxis(t,e){return Hd.copy(t).applyQuaternion(this.quaternion),this.position.add(Hd.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(Gd,t)}translateY(t){return this.translateOnAxis(Wd,t)}translateZ(t){return this.translateOnAxis(Xd,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4($i.copy(this.matrixWorld).invert())}lookAt(t,e,n){t.isVector3?Pa.copy(t):Pa.set(t,e,n);const s=this.parent;this.updateWorldMatrix(!0,!1),zo.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?$i.lookAt(zo,Pa,this.up):$i.lookAt(Pa,zo,this.up),this.quaternion.setFromRotationMatrix($i),s&&($i.extractRotation(s.matrixWorld),zr.setFromRotationMatrix($i),this.quaternion.premultiply(zr.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(console.error("THREE.Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(Yd),Vr.child=t,this.dispatchEvent(Vr),Vr.child=null):console.error("THREE.Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}const e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(aM),Ic.child=t,this.dispatchEvent(Ic),Ic.child=null),this}removeFromParent(){const t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),$i.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),$i.multiply(t.parent.matrixWorld)),t.applyMatrix4($i),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(Yd),Vr.child=t,this.dispatchEvent(Vr),Vr.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let n=0,s=this.children.length;n<s;n++){const o=this.children[n].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,n=[]){this[t]===e&&n.push(this);const s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(t,e,n);return n}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(zo,t,rM),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(zo,oM,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);const e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}traverse(t){t(this);const e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);const e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverseVisible(t)}traverseAncestors(t){const e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale),this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);const e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].updateMatrixWorld(t)}updateWorldMatrix(t,e){const n=this.parent;if(t===!0&&n!==null&&n.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),e===!0){const s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].updateWorldMatrix(!1,!0)}}toJSON(t){const e=t===void 0||typeof t=="string",n={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.6,type:"Object",generator:"Object3D.toJSON"});const s={};s.uuid=this.uuid,s.type=this.type,this.name!==""&&(s.name=this.name),this.castShadow===!0&&(s.castShadow=!0),this.receiveShadow===!0&&(s.receiveShadow=!0),this.visible===!1&&(s.visible=!1),this.frustumCulled===!1&&(s.frustumCulled=!1),this.renderOrder!==0&&(s.renderOrder=this.renderOrder),Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.matrixAutoUpdate===!1&&(s.matrixAutoUpdate=!1),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.visibility=this._visibility,s.active=this._active,s.bounds=this._bounds.map(a=>({boxInitialized:a.boxInitialized,boxMin:a.box.min.toArray(),boxMax:a.box.max.toArray(),sphereInitialized:a.sphereInitialized,sphereRadius:a.sphere.radius,sphereCenter:a.sphere.center.toArray()})),s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.geometryCount=this._geometryCount,s.matricesTexture=this._matricesTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere={center:s.boundingSphere.center.toArray(),radius:s.boundingSphere.radius}),this.boundingBox!==null&&(s.boundingBox={min:s.boundingBox.min.toArray(),max:s.boundingBox.max.toArray()}));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);const a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){const l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){const f=l[c];r(t.shapes,f)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){const a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(t.materials,this.material[l]));s.material=a}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){const l=this.animations[a];s.animations.push(r(t.animations,l))}}if(e){const a=o(t.geometries),l=o(t.materials),c=o(t.textures),h=o(t.images),f=o(t.shapes),u=o(t.skeletons),p=o(t.animations),_=o(t.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),f.length>0&&(n.shapes=f),u.length>0&&(n.skeletons=u),p.length>0&&(n.animations=p),_.length>0&&(n.nodes=_)}return n.object=s,n;function o(a){const l=[];for(const c in a){const h=a[c];delete h.metadata,l.push(h)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let n=0;n<t.children.length;n++){const s=t.children[n];this.add(s.clone())}return this}}Mn.DEFAULT_UP=new D(0,1,0);Mn.DEFAULT_MATRIX_AUTO_UPDATE=!0;Mn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;const bi=new D,Zi=new D,Fc=new D,Ki=new D,Hr=new D,Gr=new D,qd=new D,Dc=new D,Uc=new D,Nc=new D,Oc=new He,kc=new He,Bc=new He;class fi{constructor(t=new D,e=new D,n=new D){this.a=t,this.b=e,this.c=n}static getNormal(t,e,n,s){s.subVectors(n,e),bi.subVectors(t,e),s.cross(bi);const r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,n,s,r){bi.subVectors(s,e),Zi.subVectors(n,e),Fc.subVectors(t,e);const o=bi.dot(bi),a=bi.dot(Zi),l=bi.dot(Fc),c=Zi.dot(Zi),h=Zi.dot(Fc),f=o*c-a*a;if(f===0)return r.set(0,0,0),null;const u=1/f,p=(c*l-a*h)*u,_=(o*h-a*l)*u;return r.set(1-p-_,_,p)}static containsPoint(t,e,n,s){return this.getBarycoord(t,e,n,s,Ki)===null?!1:Ki.x>=0&&Ki.y>=0&&Ki.x+Ki.y<=1}static getInterpolation(t,e,n,s,r,o,a,l){return this.getBarycoord(t,e,n,s,Ki)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Ki.x),l.addScaledVector(o,Ki.y),l.addScaledVector(a,Ki.z),l)}static getInterpolatedAttribute(t,e,n,s,r,o){return Oc.setScalar(0),kc.setScalar(0),Bc.setScalar(0),Oc.fromBufferAttribute(t,e),kc.fromBufferAttribute(t,n),Bc.fromBufferAttribute(t,s),o.setScalar(0),o.addScaledVector(Oc,r.x),o.addScaledVector(kc,r.y),o.addScaledVector(Bc,r.z),o}static isFrontFacing(t,e,n,s){return bi.subVectors(n,e),Zi.subVectors(t,e),bi.cross(Zi).dot(s)<0}set(t,e,n){return this.a.copy(t),this.b.copy(e),this.c.copy(n),this}setFromPointsAndIndices(t,e,n,s){return this.a.copy(t[e]),this.b.copy(t[n]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,n,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,n),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return bi.subVectors(this.c,this.b),Zi.subVectors(this.a,this.b),bi.cross(Zi).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return fi.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return fi.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,n,s,r){return fi.getInterpolation(t,this.a,this.b,this.c,e,n,s,r)}containsPoint(t){return fi.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return fi.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){const n=this.a,s=this.b,r=this.c;let o,a;Hr.subVectors(s,n),Gr.subVectors(r,n),Dc.subVectors(t,n);const l=Hr.dot(Dc),c=Gr.dot(Dc);if(l<=0&&c<=0)return e.copy(n);Uc.subVectors(t,s);const h=Hr.dot(Uc),f=Gr.dot(Uc);if(h>=0&&f<=h)return e.copy(s);const u=l*f-h*c;if(u<=0&&l>=0&&h<=0)return o=l/(l-h),e.copy(n).addScaledVector(Hr,o);Nc.subVectors(t,r);const p=Hr.dot(Nc),_=Gr.dot(Nc);if(_>=0&&p<=_)return e.copy(r);const b=p*c-l*_;if(b<=0&&c>=0&&_<=0)return a=c/(c-_),e.copy(n).addScaledVector(Gr,a);const m=h*_-p*f;if(m<=0&&f-h>=0&&p-_>=0)return qd.subVectors(r,s),a=(f-h)/(f-h+(p-_)),e.copy(s).addScaledVector(qd,a);const d=1/(m+b+u);return o=b*d,a=u*d,e.copy(n).addScaledVector(Hr,o).addScaledVector(Gr,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}}const M_={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},As={h:0,s:0,l:0},Ca={h:0,s:0,l:0};function zc(i,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?i+(t-i)*6*e:e<1/2?t:e<2/3?i+(t-i)*6*(2/3-e):i}class re{constructor(t,e,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,n)}set(t,e,n){if(e===void 0&&n===void 0){const s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,n);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=ci){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,fe.toWorkingColorSpace(this,e),this}setRGB(t,e,n,s=fe.workingColorSpace){return this.r=t,this.g=e,this.b=n,fe.toWorkingColorSpace(this,s),this}setHSL(t,e,n,s=fe.workingColorSpace){if(t=Wx(t,1),e=Rn(e,0,1),n=Rn(n,0,1),e===0)this.r=this.g=this.b=n;else{const r=n<=.5?n*(1+e):n+e-n*e,o=2*n-r;this.r=zc(o,r,t+1/3),this.g=zc(o,r,t),this.b=zc(o,r,t-1/3)}return fe.toWorkingColorSpace(this,s),this}setStyle(t,e=ci){function n(r){r!==void 0&&parseFloat(r)<1&&console.warn("THREE.Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r;const o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+)\%\s*,\s*(\d+)\%\s*,\s*(\d+)\%\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseInt(r[1],10))/100,Math.min(100,parseInt(r[2],10))/100,Math.min(100,parseInt(r[3],10))/100,e);break;case"hsl":case"hsla":if(r=/^\s*(\d*\.?\d+)\s*,\s*(\d*\.?\d+)\%\s*,\s*(\d*\.?\d+)\%\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:console.warn("THREE.Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){const r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);console.warn("THREE.Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=ci){const n=M_[t.toLowerCase()];return n!==void 0?this.setHex(n,e):console.warn("THREE.Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=ms(t.r),this.g=ms(t.g),this.b=ms(t.b),this}copyLinearToSRGB(t){return this.r=ao(t.r),this.g=ao(t.g),this.b=ao(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=ci){return fe.fromWorkingColorSpace(Tn.copy(this),t),Math.round(Rn(Tn.r*255,0,255))*65536+Math.round(Rn(Tn.g*255,0,255))*256+Math.round(Rn(Tn.b*255,0,255))}getHexString(t=ci){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=fe.workingColorSpace){fe.fromWorkingColorSpace(Tn.copy(this),e);const n=Tn.r,s=Tn.g,r=Tn.b,o=Math.max(n,s,r),a=Math.min(n,s,r);let l,c;const h=(a+o)/2;if(a===o)l=0,c=0;else{const f=o-a;switch(c=h<=.5?f/(o+a):f/(2-o-a),o){case n:l=(s-r)/f+(s<r?6:0);break;case s:l=(r-n)/f+2;break;case r:l=(n-s)/f+4;break}l/=6}return t.h=l,t.s=c,t.l=h,t}getRGB(t,e=fe.workingColorSpace){return fe.fromWorkingColorSpace(Tn.copy(this),e),t.r=Tn.r,t.g=Tn.g,t.b=Tn.b,t}getStyle(t=ci){fe.fromWorkingColorSpace(Tn.copy(this),t);const e=Tn.r,n=Tn.g,s=Tn.b;return t!==ci?`color(${t} ${e.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(t,e,n){return this.getHSL(As),this.setHSL(As.h+t,As.s+e,As.l+n)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,n){return this.r=t.r+(e.r-t.r)*n,this.g=t.g+(e.g-t.g)*n,this.b=t.b+(e.b-t.b)*n,this}lerpHSL(t,e){this.getHSL(As),t.getHSL(Ca);const n=Sc(As.h,Ca.h,e),s=Sc(As.s,Ca.s,e),r=Sc(As.l,Ca.l,e);return this.setHSL(n,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){const e=this.r,n=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*n+r[6]*s,this.g=r[1]*e+r[4]*n+r[7]*s,this.b=r[2]*e+r[5]*n+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}}const Tn=new re;re.NAMES=M_;let lM=0;class To extends vr{static get type(){return"Material"}get type(){return this.constructor.type}set type(t){}constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:lM++}),this.uuid=aa(),this.name="",this.blending=ro,this.side=Vi,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Ah,this.blendDst=Rh,this.blendEquation=or,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new re(0,0,0),this.blendAlpha=0,this.depthFunc=mo,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Cd,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Dr,this.stencilZFail=Dr,this.stencilZPass=Dr,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(const e in t){const n=t[e];if(n===void 0){console.warn(`THREE.Material: parameter '${e}' has value of undefined.`);continue}const s=this[e];if(s===void 0){console.warn(`THREE.Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[e]=n}}toJSON(t){const e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});const n={metadata:{version:4.6,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,this.name!==""&&(n.name=this.name),this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&this.emissiveIntensity!==1&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessRange!==void 0&&(n.iridescenceThicknessRange=this.iridescenceThicknessRange),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(t).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(t).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(t).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(t).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(t).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&this.attenuationDistance!==1/0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.shadowSide!==null&&(n.shadowSide=this.shadowSide),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),this.blending!==ro&&(n.blending=this.blending),this.side!==Vi&&(n.side=this.side),this.vertexColors===!0&&(n.vertexColors=!0),this.opacity<1&&(n.opacity=this.opacity),this.transparent===!0&&(n.transparent=!0),this.blendSrc!==Ah&&(n.blendSrc=this.blendSrc),this.blendDst!==Rh&&(n.blendDst=this.blendDst),this.blendEquation!==or&&(n.blendEquation=this.blendEquation),this.blendSrcAlpha!==null&&(n.blendSrcAlpha=this.blendSrcAlpha),this.blendDstAlpha!==null&&(n.blendDstAlpha=this.blendDstAlpha),this.blendEquationAlpha!==null&&(n.blendEquationAlpha=this.blendEquationAlpha),this.blendColor&&this.blendColor.isColor&&(n.blendColor=this.blendColor.getHex()),this.blendAlpha!==0&&(n.blendAlpha=this.blendAlpha),this.depthFunc!==mo&&(n.depthFunc=this.depthFunc),this.depthTest===!1&&(n.depthTest=this.depthTest),this.depthWrite===!1&&(n.depthWrite=this.depthWrite),this.colorWrite===!1&&(n.colorWrite=this.colorWrite),this.stencilWriteMask!==255&&(n.stencilWriteMask=this.stencilWriteMask),this.stencilFunc!==Cd&&(n.stencilFunc=this.stencilFunc),this.stencilRef!==0&&(n.stencilRef=this.stencilRef),this.stencilFuncMask!==255&&(n.stencilFuncMask=this.stencilFuncMask),this.stencilFail!==Dr&&(n.stencilFail=this.stencilFail),this.stencilZFail!==Dr&&(n.stencilZFail=this.stencilZFail),this.stencilZPass!==Dr&&(n.stencilZPass=this.stencilZPass),this.stencilWrite===!0&&(n.stencilWrite=this.stencilWrite),this.rotation!==void 0&&this.rotation!==0&&(n.rotation=this.rotation),this.polygonOffset===!0&&(n.polygonOffset=!0),this.polygonOffsetFactor!==0&&(n.polygonOffsetFactor=this.polygonOffsetFactor),this.polygonOffsetUnits!==0&&(n.polygonOffsetUnits=this.polygonOffsetUnits),this.linewidth!==void 0&&this.linewidth!==1&&(n.linewidth=this.linewidth),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.dithering===!0&&(n.dithering=!0),this.alphaTest>0&&(n.alphaTest=this.alphaTest),this.alphaHash===!0&&(n.alphaHash=!0),this.alphaToCoverage===!0&&(n.alphaToCoverage=!0),this.premultipliedAlpha===!0&&(n.premultipliedAlpha=!0),this.forceSinglePass===!0&&(n.forceSinglePass=!0),this.wireframe===!0&&(n.wireframe=!0),this.wireframeLinewidth>1&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!=="round"&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!=="round"&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading===!0&&(n.flatShading=!0),this.visible===!1&&(n.visible=!1),this.toneMapped===!1&&(n.toneMapped=!1),this.fog===!1&&(n.fog=!1),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){const o=[];for(const a in r){const l=r[a];delete l.metadata,o.push(l)}return o}if(e){const r=s(t.textures),o=s(t.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;const e=t.clippingPlanes;let n=null;if(e!==null){const s=e.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=e[r].clone()}return this.clippingPlanes=n,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}onBuild(){console.warn("Material: onBuild() has been removed.")}}class jl extends To{static get type(){return"MeshBasicMaterial"}constructor(t){super(),this.isMeshBasicMaterial=!0,this.color=new re(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new gs,this.combine=ku,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}}const Ke=new D,La=new $t;class Fe{constructor(t,e,n=!1){if(Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=n,this.usage=Ld,this.updateRanges=[],this.gpuType=Ti,this.version=0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this}copyAt(t,e,n){t*=this.itemSize,n*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[n+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,n=this.count;e<n;e++)La.fromBufferAttribute(this,e),La.applyMatrix3(t),this.setXY(e,La.x,La.y);else if(this.itemSize===3)for(let e=0,n=this.count;e<n;e++)Ke.fromBufferAttribute(this,e),Ke.applyMatrix3(t),this.setXYZ(e,Ke.x,Ke.y,Ke.z);return this}applyMatrix4(t){for(let e=0,n=this.count;e<n;e++)Ke.fromBufferAttribute(this,e),Ke.applyMatrix4(t),this.setXYZ(e,Ke.x,Ke.y,Ke.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)Ke.fromBufferAttribute(this,e),Ke.applyNormalMatrix(t),this.setXYZ(e,Ke.x,Ke.y,Ke.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)Ke.fromBufferAttribute(this,e),Ke.transformDirection(t),this.setXYZ(e,Ke.x,Ke.y,Ke.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let n=this.array[t*this.itemSize+e];return this.normalized&&(n=Oo(n,this.array)),n}setComponent(t,e,n){return this.normalized&&(n=Gn(n,this.array)),this.array[t*this.itemSize+e]=n,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=Oo(e,this.array)),e}setX(t,e){return this.normalized&&(e=Gn(e,this.array)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=Oo(e,this.array)),e}setY(t,e){return this.normalized&&(e=Gn(e,this.array)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=Oo(e,this.array)),e}setZ(t,e){return this.normalized&&(e=Gn(e,this.array)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=Oo(e,this.array)),e}setW(t,e){return this.normalized&&(e=Gn(e,this.array)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,n){return t*=this.itemSize,this.normalized&&(e=Gn(e,this.array),n=Gn(n,this.array)),this.array[t+0]=e,this.array[t+1]=n,this}setXYZ(t,e,n,s){return t*=this.itemSize,this.normalized&&(e=Gn(e,this.array),n=Gn(n,this.array),s=Gn(s,this.array)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this}setXYZW(t,e,n,s,r){return t*=this.itemSize,this.normalized&&(e=Gn(e,this.array),n=Gn(n,this.array),s=Gn(s,this.array),r=Gn(r,this.array)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){const t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return this.name!==""&&(t.name=this.name),this.usage!==Ld&&(t.usage=this.usage),t}}class y_ extends Fe{constructor(t,e,n){super(new Uint16Array(t),e,n)}}class S_ extends Fe{constructor(t,e,n){super(new Uint32Array(t),e,n)}}class tn extends Fe{constructor(t,e,n){super(new Float32Array(t),e,n)}}let cM=0;const ri=new Pe,Vc=new Mn,Wr=new D,Zn=new Os,Vo=new Os,vn=new D;class en extends vr{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:cM++}),this.uuid=aa(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={}}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(g_(t)?S_:y_)(t,1):this.index=t,this}setIndirect(t){return this.indirect=t,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,n=0){this.groups.push({start:t,count:e,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){const e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);const n=this.attributes.normal;if(n!==void 0){const r=new te().getNormalMatrix(t);n.applyNormalMatrix(r),n.needsUpdate=!0}const s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this}applyQuaternion(t){return ri.makeRotationFromQuaternion(t),this.applyMatrix4(ri),this}rotateX(t){return ri.makeRotationX(t),this.applyMatrix4(ri),this}rotateY(t){return ri.makeRotationY(t),this.applyMatrix4(ri),this}rotateZ(t){return ri.makeRotationZ(t),this.applyMatrix4(ri),this}translate(t,e,n){return ri.makeTranslation(t,e,n),this.applyMatrix4(ri),this}scale(t,e,n){return ri.makeScale(t,e,n),this.applyMatrix4(ri),this}lookAt(t){return Vc.lookAt(t),Vc.updateMatrix(),this.applyMatrix4(Vc.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(Wr).negate(),this.translate(Wr.x,Wr.y,Wr.z),this}setFromPoints(t){const e=this.getAttribute("position");if(e===void 0){const n=[];for(let s=0,r=t.length;s<r;s++){const o=t[s];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new tn(n,3))}else{for(let n=0,s=e.count;n<s;n++){const r=t[n];e.setXYZ(n,r.x,r.y,r.z||0)}t.length>e.count&&console.warn("THREE.BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Os);const t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){console.error("THREE.BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new D(-1/0,-1/0,-1/0),new D(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let n=0,s=e.length;n<s;n++){const r=e[n];Zn.setFromBufferAttribute(r),this.morphTargetsRelative?(vn.addVectors(this.boundingBox.min,Zn.min),this.boundingBox.expandByPoint(vn),vn.addVectors(this.boundingBox.max,Zn.max),this.boundingBox.expandByPoint(vn)):(this.boundingBox.expandByPoint(Zn.min),this.boundingBox.expandByPoint(Zn.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&console.error('THREE.BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new xr);const t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){console.error("THREE.BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new D,1/0);return}if(t){const n=this.boundingSphere.center;if(Zn.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){const a=e[r];Vo.setFromBufferAttribute(a),this.morphTargetsRelative?(vn.addVectors(Zn.min,Vo.min),Zn.expandByPoint(vn),vn.addVectors(Zn.max,Vo.max),Zn.expandByPoint(vn)):(Zn.expandByPoint(Vo.min),Zn.expandByPoint(Vo.max))}Zn.getCenter(n);let s=0;for(let r=0,o=t.count;r<o;r++)vn.fromBufferAttribute(t,r),s=Math.max(s,n.distanceToSquared(vn));if(e)for(let r=0,o=e.length;r<o;r++){const a=e[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)vn.fromBufferAttribute(a,c),l&&(Wr.fromBufferAttribute(t,c),vn.add(Wr)),s=Math.max(s,n.distanceToSquared(vn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&console.error('THREE.BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){const t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){console.error("THREE.BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}const n=e.position,s=e.normal,r=e.uv;this.hasAttribute("tangent")===!1&&this.setAttribute("tangent",new Fe(new Float32Array(4*n.count),4));const o=this.getAttribute("tangent"),a=[],l=[];for(let F=0;F<n.count;F++)a[F]=new D,l[F]=new D;const c=new D,h=new D,f=new D,u=new $t,p=new $t,_=new $t,b=new D,m=new D;function d(F,S,x){c.fromBufferAttribute(n,F),h.fromBufferAttribute(n,S),f.fromBufferAttribute(n,x),u.fromBufferAttribute(r,F),p.fromBufferAttribute(r,S),_.fromBufferAttribute(r,x),h.sub(c),f.sub(c),p.sub(u),_.sub(u);const A=1/(p.x*_.y-_.x*p.y);isFinite(A)&&(b.copy(h).multiplyScalar(_.y).addScaledVector(f,-p.y).multiplyScalar(A),m.copy(f).multiplyScalar(p.x).addScaledVector(h,-_.x).multiplyScalar(A),a[F].add(b),a[S].add(b),a[x].add(b),l[F].add(m),l[S].add(m),l[x].add(m))}let M=this.groups;M.length===0&&(M=[{start:0,count:t.count}]);for(let F=0,S=M.length;F<S;++F){const x=M[F],A=x.start,V=x.count;for(let N=A,Y=A+V;N<Y;N+=3)d(t.getX(N+0),t.getX(N+1),t.getX(N+2))}const w=new D,v=new D,U=new D,P=new D;function L(F){U.fromBufferAttribute(s,F),P.copy(U);const S=a[F];w.copy(S),w.sub(U.multiplyScalar(U.dot(S))).normalize(),v.crossVectors(P,S);const A=v.dot(l[F])<0?-1:1;o.setXYZW(F,w.x,w.y,w.z,A)}for(let F=0,S=M.length;F<S;++F){const x=M[F],A=x.start,V=x.count;for(let N=A,Y=A+V;N<Y;N+=3)L(t.getX(N+0)),L(t.getX(N+1)),L(t.getX(N+2))}}computeVertexNormals(){const t=this.index,e=this.getAttribute("position");if(e!==void 0){let n=this.getAttribute("normal");if(n===void 0)n=new Fe(new Float32Array(e.count*3),3),this.setAttribute("normal",n);else for(let u=0,p=n.count;u<p;u++)n.setXYZ(u,0,0,0);const s=new D,r=new D,o=new D,a=new D,l=new D,c=new D,h=new D,f=new D;if(t)for(let u=0,p=t.count;u<p;u+=3){const _=t.getX(u+0),b=t.getX(u+1),m=t.getX(u+2);s.fromBufferAttribute(e,_),r.fromBufferAttribute(e,b),o.fromBufferAttribute(e,m),h.subVectors(o,r),f.subVectors(s,r),h.cross(f),a.fromBufferAttribute(n,_),l.fromBufferAttribute(n,b),c.fromBufferAttribute(n,m),a.add(h),l.add(h),c.add(h),n.setXYZ(_,a.x,a.y,a.z),n.setXYZ(b,l.x,l.y,l.z),n.setXYZ(m,c.x,c.y,c.z)}else for(let u=0,p=e.count;u<p;u+=3)s.fromBufferAttribute(e,u+0),r.fromBufferAttribute(e,u+1),o.fromBufferAttribute(e,u+2),h.subVectors(o,r),f.subVectors(s,r),h.cross(f),n.setXYZ(u+0,h.x,h.y,h.z),n.setXYZ(u+1,h.x,h.y,h.z),n.setXYZ(u+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){const t=this.attributes.normal;for(let e=0,n=t.count;e<n;e++)vn.fromBufferAttribute(t,e),vn.normalize(),t.setXYZ(e,vn.x,vn.y,vn.z)}toNonIndexed(){function t(a,l){const c=a.array,h=a.itemSize,f=a.normalized,u=new c.constructor(l.length*h);let p=0,_=0;for(let b=0,m=l.length;b<m;b++){a.isInterleavedBufferAttribute?p=l[b]*a.data.stride+a.offset:p=l[b]*h;for(let d=0;d<h;d++)u[_++]=c[p++]}return new Fe(u,h,f)}if(this.index===null)return console.warn("THREE.BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;const e=new en,n=this.index.array,s=this.attributes;for(const a in s){const l=s[a],c=t(l,n);e.setAttribute(a,c)}const r=this.morphAttributes;for(const a in r){const l=[],c=r[a];for(let h=0,f=c.length;h<f;h++){const u=c[h],p=t(u,n);l.push(p)}e.morphAttributes[a]=l}e.morphTargetsRelative=this.morphTargetsRelative;const o=this.groups;for(let a=0,l=o.length;a<l;a++){const c=o[a];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){const t={metadata:{version:4.6,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.type,this.name!==""&&(t.name=this.name),Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0){const l=this.parameters;for(const c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};const e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});const n=this.attributes;for(const l in n){const c=n[l];t.data.attributes[l]=c.toJSON(t.data)}const s={};let r=!1;for(const l in this.morphAttributes){const c=this.morphAttributes[l],h=[];for(let f=0,u=c.length;f<u;f++){const p=c[f];h.push(p.toJSON(t.data))}h.length>0&&(s[l]=h,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);const o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));const a=this.boundingSphere;return a!==null&&(t.data.boundingSphere={center:a.center.toArray(),radius:a.radius}),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;const e={};this.name=t.name;const n=t.index;n!==null&&this.setIndex(n.clone(e));const s=t.attributes;for(const c in s){const h=s[c];this.setAttribute(c,h.clone(e))}const r=t.morphAttributes;for(const c in r){const h=[],f=r[c];for(let u=0,p=f.length;u<p;u++)h.push(f[u].clone(e));this.morphAttributes[c]=h}this.morphTargetsRelative=t.morphTargetsRelative;const o=t.groups;for(let c=0,h=o.length;c<h;c++){const f=o[c];this.addGroup(f.start,f.count,f.materialIndex)}const a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());const l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this}dispose(){this.dispatchEvent({type:"dispose"})}}const jd=new Pe,Ys=new ql,Ia=new xr,$d=new D,Fa=new D,Da=new D,Ua=new D,Hc=new D,Na=new D,Zd=new D,Oa=new D;class Ye extends Mn{constructor(t=new en,e=new jl){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0&&(this.morphTargetInfluences=t.morphTargetInfluences.slice()),t.morphTargetDictionary!==void 0&&(this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary)),this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){const e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){const s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){const a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){const n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;e.fromBufferAttribute(s,t);const a=this.morphTargetInfluences;if(r&&a){Na.set(0,0,0);for(let l=0,c=r.length;l<c;l++){const h=a[l],f=r[l];h!==0&&(Hc.fromBufferAttribute(f,t),o?Na.addScaledVector(Hc,h):Na.addScaledVector(Hc.sub(e),h))}e.add(Na)}return e}raycast(t,e){const n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),Ia.copy(n.boundingSphere),Ia.applyMatrix4(r),Ys.copy(t.ray).recast(t.near),!(Ia.containsPoint(Ys.origin)===!1&&(Ys.intersectSphere(Ia,$d)===null||Ys.origin.distanceToSquared($d)>(t.far-t.near)**2))&&(jd.copy(r).invert(),Ys.copy(t.ray).applyMatrix4(jd),!(n.boundingBox!==null&&Ys.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(t,e,Ys)))}_computeIntersections(t,e,n){let s;const r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,f=r.attributes.normal,u=r.groups,p=r.drawRange;if(a!==null)if(Array.isArray(o))for(let _=0,b=u.length;_<b;_++){const m=u[_],d=o[m.materialIndex],M=Math.max(m.start,p.start),w=Math.min(a.count,Math.min(m.start+m.count,p.start+p.count));for(let v=M,U=w;v<U;v+=3){const P=a.getX(v),L=a.getX(v+1),F=a.getX(v+2);s=ka(this,d,t,n,c,h,f,P,L,F),s&&(s.faceIndex=Math.floor(v/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{const _=Math.max(0,p.start),b=Math.min(a.count,p.start+p.count);for(let m=_,d=b;m<d;m+=3){const M=a.getX(m),w=a.getX(m+1),v=a.getX(m+2);s=ka(this,o,t,n,c,h,f,M,w,v),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let _=0,b=u.length;_<b;_++){const m=u[_],d=o[m.materialIndex],M=Math.max(m.start,p.start),w=Math.min(l.count,Math.min(m.start+m.count,p.start+p.count));for(let v=M,U=w;v<U;v+=3){const P=v,L=v+1,F=v+2;s=ka(this,d,t,n,c,h,f,P,L,F),s&&(s.faceIndex=Math.floor(v/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{const _=Math.max(0,p.start),b=Math.min(l.count,p.start+p.count);for(let m=_,d=b;m<d;m+=3){const M=m,w=m+1,v=m+2;s=ka(this,o,t,n,c,h,f,M,w,v),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}}}function hM(i,t,e,n,s,r,o,a){let l;if(t.side===Cn?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,t.side===Vi,a),l===null)return null;Oa.copy(a),Oa.applyMatrix4(i.matrixWorld);const c=e.ray.origin.distanceTo(Oa);return c<e.near||c>e.far?null:{distance:c,point:Oa.clone(),object:i}}function ka(i,t,e,n,s,r,o,a,l,c){i.getVertexPosition(a,Fa),i.getVertexPosition(l,Da),i.getVertexPosition(c,Ua);const h=hM(i,t,e,n,Fa,Da,Ua,Zd);if(h){const f=new D;fi.getBarycoord(Zd,Fa,Da,Ua,f),s&&(h.uv=fi.getInterpolatedAttribute(s,a,l,c,f,new $t)),r&&(h.uv1=fi.getInterpolatedAttribute(r,a,l,c,f,new $t)),o&&(h.normal=fi.getInterpolatedAttribute(o,a,l,c,f,new D),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));const u={a,b:l,c,normal:new D,materialIndex:0};fi.getNormal(Fa,Da,Ua,u.normal),h.face=u,h.barycoord=f}return h}class Ao extends en{constructor(t=1,e=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};const a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);const l=[],c=[],h=[],f=[];let u=0,p=0;_("z","y","x",-1,-1,n,e,t,o,r,0),_("z","y","x",1,-1,n,e,-t,o,r,1),_("x","z","y",1,1,t,n,e,s,o,2),_("x","z","y",1,-1,t,n,-e,s,o,3),_("x","y","z",1,-1,t,e,n,s,r,4),_("x","y","z",-1,-1,t,e,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new tn(c,3)),this.setAttribute("normal",new tn(h,3)),this.setAttribute("uv",new tn(f,2));function _(b,m,d,M,w,v,U,P,L,F,S){const x=v/L,A=U/F,V=v/2,N=U/2,Y=P/2,X=L+1,J=F+1;let K=0,et=0;const ct=new D;for(let ht=0;ht<J;ht++){const _t=ht*A-N;for(let vt=0;vt<X;vt++){const pt=vt*x-V;ct[b]=pt*M,ct[m]=_t*w,ct[d]=Y,c.push(ct.x,ct.y,ct.z),ct[b]=0,ct[m]=0,ct[d]=P>0?1:-1,h.push(ct.x,ct.y,ct.z),f.push(vt/L),f.push(1-ht/F),K+=1}}for(let ht=0;ht<F;ht++)for(let _t=0;_t<L;_t++){const vt=u+_t+X*ht,pt=u+_t+X*(ht+1),st=u+(_t+1)+X*(ht+1),lt=u+(_t+1)+X*ht;l.push(vt,pt,lt),l.push(pt,st,lt),et+=6}a.addGroup(p,et,S),p+=et,u+=K}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new Ao(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}}function Mo(i){const t={};for(const e in i){t[e]={};for(const n in i[e]){const s=i[e][n];s&&(s.isColor||s.isMatrix3||s.isMatrix4||s.isVector2||s.isVector3||s.isVector4||s.isTexture||s.isQuaternion)?s.isRenderTargetTexture?(console.warn("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][n]=null):t[e][n]=s.clone():Array.isArray(s)?t[e][n]=s.slice():t[e][n]=s}}return t}function Nn(i){const t={};for(let e=0;e<i.length;e++){const n=Mo(i[e]);for(const s in n)t[s]=n[s]}return t}function uM(i){const t=[];for(let e=0;e<i.length;e++)t.push(i[e].clone());return t}function w_(i){const t=i.getRenderTarget();return t===null?i.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:fe.workingColorSpace}const Xu={clone:Mo,merge:Nn};var fM=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,dM=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`;class Hi extends To{static get type(){return"ShaderMaterial"}constructor(t){super(),this.isShaderMaterial=!0,this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=fM,this.fragmentShader=dM,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=Mo(t.uniforms),this.uniformsGroups=uM(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this}toJSON(t){const e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(const s in this.uniforms){const o=this.uniforms[s].value;o&&o.isTexture?e.uniforms[s]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[s]={type:"m4",value:o.toArray()}:e.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;const n={};for(const s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(e.extensions=n),e}}class Yu extends Mn{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Pe,this.projectionMatrix=new Pe,this.projectionMatrixInverse=new Pe,this.coordinateSystem=hs}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorldInverse.copy(this.matrixWorld).invert()}updateWorldMatrix(t,e){super.updateWorldMatrix(t,e),this.matrixWorldInverse.copy(this.matrixWorld).invert()}clone(){return new this.constructor().copy(this)}}const Rs=new D,Kd=new $t,Jd=new $t;class hi extends Yu{constructor(t=50,e=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){const e=.5*this.getFilmHeight()/t;this.fov=fu*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){const t=Math.tan(al*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return fu*2*Math.atan(Math.tan(al*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,n){Rs.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(Rs.x,Rs.y).multiplyScalar(-t/Rs.z),Rs.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(Rs.x,Rs.y).multiplyScalar(-t/Rs.z)}getViewSize(t,e){return this.getViewBounds(t,Kd,Jd),e.subVectors(Jd,Kd)}setViewOffset(t,e,n,s,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){const t=this.near;let e=t*Math.tan(al*.5*this.fov)/this.zoom,n=2*e,s=this.aspect*n,r=-.5*s;const o=this.view;if(this.view!==null&&this.view.enabled){const l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,e-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}const a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-n,t,this.far,this.coordinateSystem),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){const e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}}const Xr=-90,Yr=1;class pM extends Mn{constructor(t,e,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;const s=new hi(Xr,Yr,t,e);s.layers=this.layers,this.add(s);const r=new hi(Xr,Yr,t,e);r.layers=this.layers,this.add(r);const o=new hi(Xr,Yr,t,e);o.layers=this.layers,this.add(o);const a=new hi(Xr,Yr,t,e);a.layers=this.layers,this.add(a);const l=new hi(Xr,Yr,t,e);l.layers=this.layers,this.add(l);const c=new hi(Xr,Yr,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){const t=this.coordinateSystem,e=this.children.concat(),[n,s,r,o,a,l]=e;for(const c of e)this.remove(c);if(t===hs)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===Rl)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(const c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();const{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());const[r,o,a,l,c,h]=this.children,f=t.getRenderTarget(),u=t.getActiveCubeFace(),p=t.getActiveMipmapLevel(),_=t.xr.enabled;t.xr.enabled=!1;const b=n.texture.generateMipmaps;n.texture.generateMipmaps=!1,t.setRenderTarget(n,0,s),t.render(e,r),t.setRenderTarget(n,1,s),t.render(e,o),t.setRenderTarget(n,2,s),t.render(e,a),t.setRenderTarget(n,3,s),t.render(e,l),t.setRenderTarget(n,4,s),t.render(e,c),n.texture.generateMipmaps=b,t.setRenderTarget(n,5,s),t.render(e,h),t.setRenderTarget(f,u,p),t.xr.enabled=_,n.texture.needsPMREMUpdate=!0}}class E_ extends zn{constructor(t,e,n,s,r,o,a,l,c,h){t=t!==void 0?t:[],e=e!==void 0?e:_o,super(t,e,n,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}}class mM extends Ds{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;const n={width:t,height:t,depth:1},s=[n,n,n,n,n,n];this.texture=new E_(s,e.mapping,e.wrapS,e.wrapT,e.magFilter,e.minFilter,e.format,e.type,e.anisotropy,e.colorSpace),this.texture.isRenderTargetTexture=!0,this.texture.generateMipmaps=e.generateMipmaps!==void 0?e.generateMipmaps:!1,this.texture.minFilter=e.minFilter!==void 0?e.minFilter:Ei}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;const n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new Ao(5,5,5),r=new Hi({name:"CubemapFromEquirect",uniforms:Mo(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:Cn,blending:ps});r.uniforms.tEquirect.value=e;const o=new Ye(s,r),a=e.minFilter;return e.minFilter===cr&&(e.minFilter=Ei),new pM(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e,n,s){const r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,n,s);t.setRenderTarget(r)}}const Gc=new D,_M=new D,gM=new te;class cs{constructor(t=new D(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,n,s){return this.normal.set(t,e,n),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,n){const s=Gc.subVectors(n,e).cross(_M.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){const t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e){const n=t.delta(Gc),s=this.normal.dot(n);if(s===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;const r=-(t.start.dot(this.normal)+this.constant)/s;return r<0||r>1?null:e.copy(t.start).addScaledVector(n,r)}intersectsLine(t){const e=this.distanceToPoint(t.start),n=this.distanceToPoint(t.end);return e<0&&n>0||n<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){const n=e||gM.getNormalMatrix(t),s=this.coplanarPoint(Gc).applyMatrix4(t),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}}const qs=new xr,Ba=new D;class qu{constructor(t=new cs,e=new cs,n=new cs,s=new cs,r=new cs,o=new cs){this.planes=[t,e,n,s,r,o]}set(t,e,n,s,r,o){const a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(t){const e=this.planes;for(let n=0;n<6;n++)e[n].copy(t.planes[n]);return this}setFromProjectionMatrix(t,e=hs){const n=this.planes,s=t.elements,r=s[0],o=s[1],a=s[2],l=s[3],c=s[4],h=s[5],f=s[6],u=s[7],p=s[8],_=s[9],b=s[10],m=s[11],d=s[12],M=s[13],w=s[14],v=s[15];if(n[0].setComponents(l-r,u-c,m-p,v-d).normalize(),n[1].setComponents(l+r,u+c,m+p,v+d).normalize(),n[2].setComponents(l+o,u+h,m+_,v+M).normalize(),n[3].setComponents(l-o,u-h,m-_,v-M).normalize(),n[4].setComponents(l-a,u-f,m-b,v-w).normalize(),e===hs)n[5].setComponents(l+a,u+f,m+b,v+w).normalize();else if(e===Rl)n[5].setComponents(a,f,b,w).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),qs.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{const e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),qs.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(qs)}intersectsSprite(t){return qs.center.set(0,0,0),qs.radius=.7071067811865476,qs.applyMatrix4(t.matrixWorld),this.intersectsSphere(qs)}intersectsSphere(t){const e=this.planes,n=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(t){const e=this.planes;for(let n=0;n<6;n++){const s=e[n];if(Ba.x=s.normal.x>0?t.max.x:t.min.x,Ba.y=s.normal.y>0?t.max.y:t.min.y,Ba.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(Ba)<0)return!1}return!0}containsPoint(t){const e=this.planes;for(let n=0;n<6;n++)if(e[n].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}}function T_(){let i=null,t=!1,e=null,n=null;function s(r,o){e(r,o),n=i.requestAnimationFrame(s)}return{start:function(){t!==!0&&e!==null&&(n=i.requestAnimationFrame(s),t=!0)},stop:function(){i.cancelAnimationFrame(n),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){i=r}}}function bM(i){const t=new WeakMap;function e(a,l){const c=a.array,h=a.usage,f=c.byteLength,u=i.createBuffer();i.bindBuffer(l,u),i.bufferData(l,c,h),a.onUploadCallback();let p;if(c instanceof Float32Array)p=i.FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?p=i.HALF_FLOAT:p=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)p=i.SHORT;else if(c instanceof Uint32Array)p=i.UNSIGNED_INT;else if(c instanceof Int32Array)p=i.INT;else if(c instanceof Int8Array)p=i.BYTE;else if(c instanceof Uint8Array)p=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)p=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:u,type:p,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:f}}function n(a,l,c){const h=l.array,f=l.updateRanges;if(i.bindBuffer(c,a),f.length===0)i.bufferSubData(c,0,h);else{f.sort((p,_)=>p.start-_.start);let u=0;for(let p=1;p<f.length;p++){const _=f[u],b=f[p];b.start<=_.start+_.count+1?_.count=Math.max(_.count,b.start+b.count-_.start):(++u,f[u]=b)}f.length=u+1;for(let p=0,_=f.length;p<_;p++){const b=f[p];i.bufferSubData(c,b.start*h.BYTES_PER_ELEMENT,h,b.start,b.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);const l=t.get(a);l&&(i.deleteBuffer(l.buffer),t.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){const h=t.get(a);(!h||h.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}const c=t.get(a);if(c===void 0)t.set(a,e(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}class la extends en{constructor(t=1,e=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:n,heightSegments:s};const r=t/2,o=e/2,a=Math.floor(n),l=Math.floor(s),c=a+1,h=l+1,f=t/a,u=e/l,p=[],_=[],b=[],m=[];for(let d=0;d<h;d++){const M=d*u-o;for(let w=0;w<c;w++){const v=w*f-r;_.push(v,-M,0),b.push(0,0,1),m.push(w/a),m.push(1-d/l)}}for(let d=0;d<l;d++)for(let M=0;M<a;M++){const w=M+c*d,v=M+c*(d+1),U=M+1+c*(d+1),P=M+1+c*d;p.push(w,v,P),p.push(v,U,P)}this.setIndex(p),this.setAttribute("position",new tn(_,3)),this.setAttribute("normal",new tn(b,3)),this.setAttribute("uv",new tn(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new la(t.width,t.height,t.widthSegments,t.heightSegments)}}var vM=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,xM=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,MM=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,yM=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,SM=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,wM=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,EM=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,TM=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,AM=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec3 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 ).rgb;
	}
#endif`,RM=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,PM=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,CM=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,LM=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,IM=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,FM=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,DM=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,UM=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,NM=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,OM=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,kM=`#if defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#elif defined( USE_COLOR )
	diffuseColor.rgb *= vColor;
#endif`,BM=`#if defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#elif defined( USE_COLOR )
	varying vec3 vColor;
#endif`,zM=`#if defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#elif defined( USE_COLOR ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec3 vColor;
#endif`,VM=`#if defined( USE_COLOR_ALPHA )
	vColor = vec4( 1.0 );
#elif defined( USE_COLOR ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec3( 1.0 );
#endif
#ifdef USE_COLOR
	vColor *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.xyz *= instanceColor.xyz;
#endif
#ifdef USE_BATCHING_COLOR
	vec3 batchingColor = getBatchingColor( getIndirectIndex( gl_DrawID ) );
	vColor.xyz *= batchingColor.xyz;
#endif`,HM=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
vec3 inverseTransformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( vec4( dir, 0.0 ) * matrix ).xyz );
}
mat3 transposeMat3( const in mat3 m ) {
	mat3 tmp;
	tmp[ 0 ] = vec3( m[ 0 ].x, m[ 1 ].x, m[ 2 ].x );
	tmp[ 1 ] = vec3( m[ 0 ].y, m[ 1 ].y, m[ 2 ].y );
	tmp[ 2 ] = vec3( m[ 0 ].z, m[ 1 ].z, m[ 2 ].z );
	return tmp;
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,GM=`#ifdef ENVMAP_TYPE_CUBE_UV
	#define cubeUV_minMipLevel 4.0
	#define cubeUV_minTileSize 16.0
	float getFace( vec3 direction ) {
		vec3 absDirection = abs( direction );
		float face = - 1.0;
		if ( absDirection.x > absDirection.z ) {
			if ( absDirection.x > absDirection.y )
				face = direction.x > 0.0 ? 0.0 : 3.0;
			else
				face = direction.y > 0.0 ? 1.0 : 4.0;
		} else {
			if ( absDirection.z > absDirection.y )
				face = direction.z > 0.0 ? 2.0 : 5.0;
			else
				face = direction.y > 0.0 ? 1.0 : 4.0;
		}
		return face;
	}
	vec2 getUV( vec3 direction, float face ) {
		vec2 uv;
		if ( face == 0.0 ) {
			uv = vec2( direction.z, direction.y ) / abs( direction.x );
		} else if ( face == 1.0 ) {
			uv = vec2( - direction.x, - direction.z ) / abs( direction.y );
		} else if ( face == 2.0 ) {
			uv = vec2( - direction.x, direction.y ) / abs( direction.z );
		} else if ( face == 3.0 ) {
			uv = vec2( - direction.z, direction.y ) / abs( direction.x );
		} else if ( face == 4.0 ) {
			uv = vec2( - direction.x, direction.z ) / abs( direction.y );
		} else {
			uv = vec2( direction.x, direction.y ) / abs( direction.z );
		}
		return 0.5 * ( uv + 1.0 );
	}
	vec3 bilinearCubeUV( sampler2D envMap, vec3 direction, float mipInt ) {
		float face = getFace( direction );
		float filterInt = max( cubeUV_minMipLevel - mipInt, 0.0 );
		mipInt = max( mipInt, cubeUV_minMipLevel );
		float faceSize = exp2( mipInt );
		highp vec2 uv = getUV( direction, face ) * ( faceSize - 2.0 ) + 1.0;
		if ( face > 2.0 ) {
			uv.y += faceSize;
			face -= 3.0;
		}
		uv.x += face * faceSize;
		uv.x += filterInt * 3.0 * cubeUV_minTileSize;
		uv.y += 4.0 * ( exp2( CUBEUV_MAX_MIP ) - faceSize );
		uv.x *= CUBEUV_TEXEL_WIDTH;
		uv.y *= CUBEUV_TEXEL_HEIGHT;
		#ifdef texture2DGradEXT
			return texture2DGradEXT( envMap, uv, vec2( 0.0 ), vec2( 0.0 ) ).rgb;
		#else
			return texture2D( envMap, uv ).rgb;
		#endif
	}
	#define cubeUV_r0 1.0
	#define cubeUV_m0 - 2.0
	#define cubeUV_r1 0.8
	#define cubeUV_m1 - 1.0
	#define cubeUV_r4 0.4
	#define cubeUV_m4 2.0
	#define cubeUV_r5 0.305
	#define cubeUV_m5 3.0
	#define cubeUV_r6 0.21
	#define cubeUV_m6 4.0
	float roughnessToMip( float roughness ) {
		float mip = 0.0;
		if ( roughness >= cubeUV_r1 ) {
			mip = ( cubeUV_r0 - roughness ) * ( cubeUV_m1 - cubeUV_m0 ) / ( cubeUV_r0 - cubeUV_r1 ) + cubeUV_m0;
		} else if ( roughness >= cubeUV_r4 ) {
			mip = ( cubeUV_r1 - roughness ) * ( cubeUV_m4 - cubeUV_m1 ) / ( cubeUV_r1 - cubeUV_r4 ) + cubeUV_m1;
		} else if ( roughness >= cubeUV_r5 ) {
			mip = ( cubeUV_r4 - roughness ) * ( cubeUV_m5 - cubeUV_m4 ) / ( cubeUV_r4 - cubeUV_r5 ) + cubeUV_m4;
		} else if ( roughness >= cubeUV_r6 ) {
			mip = ( cubeUV_r5 - roughness ) * ( cubeUV_m6 - cubeUV_m5 ) / ( cubeUV_r5 - cubeUV_r6 ) + cubeUV_m5;
		} else {
			mip = - 2.0 * log2( 1.16 * roughness );		}
		return mip;
	}
	vec4 textureCubeUV( sampler2D envMap, vec3 sampleDir, float roughness ) {
		float mip = clamp( roughnessToMip( roughness ), cubeUV_m0, CUBEUV_MAX_MIP );
		float mipF = fract( mip );
		float mipInt = floor( mip );
		vec3 color0 = bilinearCubeUV( envMap, sampleDir, mipInt );
		if ( mipF == 0.0 ) {
			return vec4( color0, 1.0 );
		} else {
			vec3 color1 = bilinearCubeUV( envMap, sampleDir, mipInt + 1.0 );
			return vec4( mix( color0, color1, mipF ), 1.0 );
		}
	}
#endif`,WM=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
	#ifdef FLIP_SIDED
		transformedTangent = - transformedTangent;
	#endif
#endif`,XM=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,YM=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,qM=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,jM=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,$M="gl_FragColor = linearToOutputTexel( gl_FragColor );",ZM=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,KM=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = inverseTransformDirection( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * vec3( flipEnvMap * reflectVec.x, reflectVec.yz ) );
	#else
		vec4 envColor = vec4( 0.0 );
	#endif
	#ifdef ENVMAP_BLENDING_MULTIPLY
		outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
	#elif defined( ENVMAP_BLENDING_MIX )
		outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
	#elif defined( ENVMAP_BLENDING_ADD )
		outgoingLight += envColor.xyz * specularStrength * reflectivity;
	#endif
#endif`,JM=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform float flipEnvMap;
	uniform mat3 envMapRotation;
	#ifdef ENVMAP_TYPE_CUBE
		uniform samplerCube envMap;
	#else
		uniform sampler2D envMap;
	#endif
	
#endif`,QM=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,ty=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,ey=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = inverseTransformDirection( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,ny=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,iy=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,sy=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,ry=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,oy=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,ay=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,ly=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,cy=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,hy=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = inverseTransformDirection( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif`,uy=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_CUBE_UV
			vec3 worldNormal = inverseTransformDirection( normal, viewMatrix );
			vec4 envMapColor = textureCubeUV( envMap, envMapRotation * worldNormal, 1.0 );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_CUBE_UV
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, roughness * roughness) );
			reflectVec = inverseTransformDirection( reflectVec, viewMatrix );
			vec4 envMapColor = textureCubeUV( envMap, envMapRotation * reflectVec, roughness );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_CUBE_UV
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
#endif`,fy=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,dy=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,py=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,my=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,_y=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb * ( 1.0 - metalnessFactor );
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.0525 );material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = mix( min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = mix( vec3( 0.04 ), diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.0525 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.07, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,gy=`struct PhysicalMaterial {
	vec3 diffuseColor;
	float roughness;
	vec3 specularColor;
	float specularF90;
	float dispersion;
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		float v = 0.5 / ( gv + gl );
		return saturate(v);
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = material.clearcoatRoughness;
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColor;
	float f90 = material.specularF90;
	float roughness = material.roughness;
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float V = V_GGX_SmithCorrelated_Anisotropic( material.alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( material.alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transposeMat3( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float a = roughness < 0.25 ? -339.2 * r2 + 161.4 * roughness - 25.9 : -8.48 * r2 + 14.3 * roughness - 9.95;
	float b = roughness < 0.25 ? 44.0 * r2 - 23.7 * roughness + 3.26 : 1.97 * r2 - 3.27 * roughness + 0.72;
	float DG = exp( a * dotNV + b ) + ( roughness < 0.25 ? 0.0 : 0.1 * ( roughness - 0.25 ) );
	return saturate( DG * RECIPROCAL_PI );
}
vec2 DFGApprox( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	const vec4 c0 = vec4( - 1, - 0.0275, - 0.572, 0.022 );
	const vec4 c1 = vec4( 1, 0.0425, 1.04, - 0.04 );
	vec4 r = roughness * c0 + c1;
	float a004 = min( r.x * r.x, exp2( - 9.28 * dotNV ) ) * r.x + r.y;
	vec2 fab = vec2( - 1.04, 1.04 ) * a004 + r.zw;
	return fab;
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	vec2 fab = DFGApprox( normal, viewDir, roughness );
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, const in float roughness, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	vec2 fab = DFGApprox( normal, viewDir, roughness );
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColor * t2.x + ( vec3( 1.0 ) - material.specularColor ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseColor * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
	#endif
	reflectedLight.directSpecular += irradiance * BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
	#endif
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( geometryNormal, geometryViewDir, material.specularColor, material.specularF90, material.iridescence, material.iridescenceFresnel, material.roughness, singleScattering, multiScattering );
	#else
		computeMultiscattering( geometryNormal, geometryViewDir, material.specularColor, material.specularF90, material.roughness, singleScattering, multiScattering );
	#endif
	vec3 totalScattering = singleScattering + multiScattering;
	vec3 diffuse = material.diffuseColor * ( 1.0 - max( max( totalScattering.r, totalScattering.g ), totalScattering.b ) );
	reflectedLight.indirectSpecular += radiance * singleScattering;
	reflectedLight.indirectSpecular += multiScattering * cosineWeightedIrradiance;
	reflectedLight.indirectDiffuse += diffuse * cosineWeightedIrradiance;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,by=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		material.iridescenceFresnel = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		material.iridescenceF0 = Schlick_to_F0( material.iridescenceFresnel, 1.0, dotNVi );
	}
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,vy=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD ) && defined( ENVMAP_TYPE_CUBE_UV )
		iblIrradiance += getIBLIrradiance( geometryNormal );
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		radiance += getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		radiance += getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,xy=`#if defined( RE_IndirectDiffuse )
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,My=`#if defined( USE_LOGDEPTHBUF )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,yy=`#if defined( USE_LOGDEPTHBUF )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,Sy=`#ifdef USE_LOGDEPTHBUF
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,wy=`#ifdef USE_LOGDEPTHBUF
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,Ey=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,Ty=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,Ay=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,Ry=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Py=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,Cy=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,Ly=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,Iy=`#if defined( USE_MORPHCOLORS )
	vColor *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,Fy=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Dy=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,Uy=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Ny=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#if defined( DOUBLE_SIDED ) && ! defined( FLAT_SHADED )
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#if defined( DOUBLE_SIDED ) && ! defined( FLAT_SHADED )
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,Oy=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,ky=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,By=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,zy=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
	#endif
#endif`,Vy=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,Hy=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,Gy=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,Wy=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,Xy=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,Yy=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,qy=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	return depth * ( near - far ) - near;
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	return ( near * far ) / ( ( far - near ) * depth - far );
}`,jy=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,$y=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Zy=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,Ky=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,Jy=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Qy=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,tS=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform sampler2D pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	float texture2DCompare( sampler2D depths, vec2 uv, float compare ) {
		return step( compare, unpackRGBAToDepth( texture2D( depths, uv ) ) );
	}
	vec2 texture2DDistribution( sampler2D shadow, vec2 uv ) {
		return unpackRGBATo2Half( texture2D( shadow, uv ) );
	}
	float VSMShadow (sampler2D shadow, vec2 uv, float compare ){
		float occlusion = 1.0;
		vec2 distribution = texture2DDistribution( shadow, uv );
		float hard_shadow = step( compare , distribution.x );
		if (hard_shadow != 1.0 ) {
			float distance = compare - distribution.x ;
			float variance = max( 0.00000, distribution.y * distribution.y );
			float softness_probability = variance / (variance + distance * distance );			softness_probability = clamp( ( softness_probability - 0.3 ) / ( 0.95 - 0.3 ), 0.0, 1.0 );			occlusion = clamp( max( hard_shadow, softness_probability ), 0.0, 1.0 );
		}
		return occlusion;
	}
	float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
		float shadow = 1.0;
		shadowCoord.xyz /= shadowCoord.w;
		shadowCoord.z += shadowBias;
		bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
		bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
		if ( frustumTest ) {
		#if defined( SHADOWMAP_TYPE_PCF )
			vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
			float dx0 = - texelSize.x * shadowRadius;
			float dy0 = - texelSize.y * shadowRadius;
			float dx1 = + texelSize.x * shadowRadius;
			float dy1 = + texelSize.y * shadowRadius;
			float dx2 = dx0 / 2.0;
			float dy2 = dy0 / 2.0;
			float dx3 = dx1 / 2.0;
			float dy3 = dy1 / 2.0;
			shadow = (
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx0, dy0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( 0.0, dy0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx1, dy0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx2, dy2 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( 0.0, dy2 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx3, dy2 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx0, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx2, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy, shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx3, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx1, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx2, dy3 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( 0.0, dy3 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx3, dy3 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx0, dy1 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( 0.0, dy1 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, shadowCoord.xy + vec2( dx1, dy1 ), shadowCoord.z )
			) * ( 1.0 / 17.0 );
		#elif defined( SHADOWMAP_TYPE_PCF_SOFT )
			vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
			float dx = texelSize.x;
			float dy = texelSize.y;
			vec2 uv = shadowCoord.xy;
			vec2 f = fract( uv * shadowMapSize + 0.5 );
			uv -= f * texelSize;
			shadow = (
				texture2DCompare( shadowMap, uv, shadowCoord.z ) +
				texture2DCompare( shadowMap, uv + vec2( dx, 0.0 ), shadowCoord.z ) +
				texture2DCompare( shadowMap, uv + vec2( 0.0, dy ), shadowCoord.z ) +
				texture2DCompare( shadowMap, uv + texelSize, shadowCoord.z ) +
				mix( texture2DCompare( shadowMap, uv + vec2( -dx, 0.0 ), shadowCoord.z ),
					 texture2DCompare( shadowMap, uv + vec2( 2.0 * dx, 0.0 ), shadowCoord.z ),
					 f.x ) +
				mix( texture2DCompare( shadowMap, uv + vec2( -dx, dy ), shadowCoord.z ),
					 texture2DCompare( shadowMap, uv + vec2( 2.0 * dx, dy ), shadowCoord.z ),
					 f.x ) +
				mix( texture2DCompare( shadowMap, uv + vec2( 0.0, -dy ), shadowCoord.z ),
					 texture2DCompare( shadowMap, uv + vec2( 0.0, 2.0 * dy ), shadowCoord.z ),
					 f.y ) +
				mix( texture2DCompare( shadowMap, uv + vec2( dx, -dy ), shadowCoord.z ),
					 texture2DCompare( shadowMap, uv + vec2( dx, 2.0 * dy ), shadowCoord.z ),
					 f.y ) +
				mix( mix( texture2DCompare( shadowMap, uv + vec2( -dx, -dy ), shadowCoord.z ),
						  texture2DCompare( shadowMap, uv + vec2( 2.0 * dx, -dy ), shadowCoord.z ),
						  f.x ),
					 mix( texture2DCompare( shadowMap, uv + vec2( -dx, 2.0 * dy ), shadowCoord.z ),
						  texture2DCompare( shadowMap, uv + vec2( 2.0 * dx, 2.0 * dy ), shadowCoord.z ),
						  f.x ),
					 f.y )
			) * ( 1.0 / 9.0 );
		#elif defined( SHADOWMAP_TYPE_VSM )
			shadow = VSMShadow( shadowMap, shadowCoord.xy, shadowCoord.z );
		#else
			shadow = texture2DCompare( shadowMap, shadowCoord.xy, shadowCoord.z );
		#endif
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	vec2 cubeToUV( vec3 v, float texelSizeY ) {
		vec3 absV = abs( v );
		float scaleToCube = 1.0 / max( absV.x, max( absV.y, absV.z ) );
		absV *= scaleToCube;
		v *= scaleToCube * ( 1.0 - 2.0 * texelSizeY );
		vec2 planar = v.xy;
		float almostATexel = 1.5 * texelSizeY;
		float almostOne = 1.0 - almostATexel;
		if ( absV.z >= almostOne ) {
			if ( v.z > 0.0 )
				planar.x = 4.0 - v.x;
		} else if ( absV.x >= almostOne ) {
			float signX = sign( v.x );
			planar.x = v.z * signX + 2.0 * signX;
		} else if ( absV.y >= almostOne ) {
			float signY = sign( v.y );
			planar.x = v.x + 2.0 * signY + 2.0;
			planar.y = v.z * signY - 2.0;
		}
		return vec2( 0.125, 0.25 ) * planar + vec2( 0.375, 0.75 );
	}
	float getPointShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		
		float lightToPositionLength = length( lightToPosition );
		if ( lightToPositionLength - shadowCameraFar <= 0.0 && lightToPositionLength - shadowCameraNear >= 0.0 ) {
			float dp = ( lightToPositionLength - shadowCameraNear ) / ( shadowCameraFar - shadowCameraNear );			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			vec2 texelSize = vec2( 1.0 ) / ( shadowMapSize * vec2( 4.0, 2.0 ) );
			#if defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_PCF_SOFT ) || defined( SHADOWMAP_TYPE_VSM )
				vec2 offset = vec2( - 1, 1 ) * shadowRadius * texelSize.y;
				shadow = (
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.xyy, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.yyy, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.xyx, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.yyx, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.xxy, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.yxy, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.xxx, texelSize.y ), dp ) +
					texture2DCompare( shadowMap, cubeToUV( bd3D + offset.yxx, texelSize.y ), dp )
				) * ( 1.0 / 9.0 );
			#else
				shadow = texture2DCompare( shadowMap, cubeToUV( bd3D, texelSize.y ), dp );
			#endif
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
#endif`,eS=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,nS=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	vec3 shadowWorldNormal = inverseTransformDirection( transformedNormal, viewMatrix );
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,iS=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,sS=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,rS=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,oS=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,aS=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,lS=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,cS=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,hS=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,uS=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,fS=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = inverseTransformDirection( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseColor, material.specularColor, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,dS=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
		
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
		
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		
		#else
		
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,pS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,mS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,_S=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,gS=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`;const bS=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,vS=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,xS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,MS=`#ifdef ENVMAP_TYPE_CUBE
	uniform samplerCube envMap;
#elif defined( ENVMAP_TYPE_CUBE_UV )
	uniform sampler2D envMap;
#endif
uniform float flipEnvMap;
uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <cube_uv_reflection_fragment>
void main() {
	#ifdef ENVMAP_TYPE_CUBE
		vec4 texColor = textureCube( envMap, backgroundRotation * vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) );
	#elif defined( ENVMAP_TYPE_CUBE_UV )
		vec4 texColor = textureCubeUV( envMap, backgroundRotation * vWorldDirection, backgroundBlurriness );
	#else
		vec4 texColor = vec4( 0.0, 0.0, 0.0, 1.0 );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,yS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,SS=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,wS=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,ES=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	float fragCoordZ = 0.5 * vHighPrecisionZW[0] / vHighPrecisionZW[1] + 0.5;
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,TS=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,AS=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main () {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = packDepthToRGBA( dist );
}`,RS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,PS=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,CS=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,LS=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,IS=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,FS=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,DS=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,US=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <packing>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,NS=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,OS=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,kS=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,BS=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <packing>
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( packNormalToRGB( normal ), diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,zS=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,VS=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <packing>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,HS=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,GS=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <packing>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <cube_uv_reflection_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
		float sheenEnergyComp = 1.0 - 0.157 * max3( material.sheenColor );
		outgoingLight = outgoingLight * sheenEnergyComp + sheenSpecularDirect + sheenSpecularIndirect;
	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,WS=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,XS=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <packing>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,YS=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,qS=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,jS=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,$S=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <packing>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,ZS=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,KS=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,ne={alphahash_fragment:vM,alphahash_pars_fragment:xM,alphamap_fragment:MM,alphamap_pars_fragment:yM,alphatest_fragment:SM,alphatest_pars_fragment:wM,aomap_fragment:EM,aomap_pars_fragment:TM,batching_pars_vertex:AM,batching_vertex:RM,begin_vertex:PM,beginnormal_vertex:CM,bsdfs:LM,iridescence_fragment:IM,bumpmap_pars_fragment:FM,clipping_planes_fragment:DM,clipping_planes_pars_fragment:UM,clipping_planes_pars_vertex:NM,clipping_planes_vertex:OM,color_fragment:kM,color_pars_fragment:BM,color_pars_vertex:zM,color_vertex:VM,common:HM,cube_uv_reflection_fragment:GM,defaultnormal_vertex:WM,displacementmap_pars_vertex:XM,displacementmap_vertex:YM,emissivemap_fragment:qM,emissivemap_pars_fragment:jM,colorspace_fragment:$M,colorspace_pars_fragment:ZM,envmap_fragment:KM,envmap_common_pars_fragment:JM,envmap_pars_fragment:QM,envmap_pars_vertex:ty,envmap_physical_pars_fragment:uy,envmap_vertex:ey,fog_vertex:ny,fog_pars_vertex:iy,fog_fragment:sy,fog_pars_fragment:ry,gradientmap_pars_fragment:oy,lightmap_pars_fragment:ay,lights_lambert_fragment:ly,lights_lambert_pars_fragment:cy,lights_pars_begin:hy,lights_toon_fragment:fy,lights_toon_pars_fragment:dy,lights_phong_fragment:py,lights_phong_pars_fragment:my,lights_physical_fragment:_y,lights_physical_pars_fragment:gy,lights_fragment_begin:by,lights_fragment_maps:vy,lights_fragment_end:xy,logdepthbuf_fragment:My,logdepthbuf_pars_fragment:yy,logdepthbuf_pars_vertex:Sy,logdepthbuf_vertex:wy,map_fragment:Ey,map_pars_fragment:Ty,map_particle_fragment:Ay,map_particle_pars_fragment:Ry,metalnessmap_fragment:Py,metalnessmap_pars_fragment:Cy,morphinstance_vertex:Ly,morphcolor_vertex:Iy,morphnormal_vertex:Fy,morphtarget_pars_vertex:Dy,morphtarget_vertex:Uy,normal_fragment_begin:Ny,normal_fragment_maps:Oy,normal_pars_fragment:ky,normal_pars_vertex:By,normal_vertex:zy,normalmap_pars_fragment:Vy,clearcoat_normal_fragment_begin:Hy,clearcoat_normal_fragment_maps:Gy,clearcoat_pars_fragment:Wy,iridescence_pars_fragment:Xy,opaque_fragment:Yy,packing:qy,premultiplied_alpha_fragment:jy,project_vertex:$y,dithering_fragment:Zy,dithering_pars_fragment:Ky,roughnessmap_fragment:Jy,roughnessmap_pars_fragment:Qy,shadowmap_pars_fragment:tS,shadowmap_pars_vertex:eS,shadowmap_vertex:nS,shadowmask_pars_fragment:iS,skinbase_vertex:sS,skinning_pars_vertex:rS,skinning_vertex:oS,skinnormal_vertex:aS,specularmap_fragment:lS,specularmap_pars_fragment:cS,tonemapping_fragment:hS,tonemapping_pars_fragment:uS,transmission_fragment:fS,transmission_pars_fragment:dS,uv_pars_fragment:pS,uv_pars_vertex:mS,uv_vertex:_S,worldpos_vertex:gS,background_vert:bS,background_frag:vS,backgroundCube_vert:xS,backgroundCube_frag:MS,cube_vert:yS,cube_frag:SS,depth_vert:wS,depth_frag:ES,distanceRGBA_vert:TS,distanceRGBA_frag:AS,equirect_vert:RS,equirect_frag:PS,linedashed_vert:CS,linedashed_frag:LS,meshbasic_vert:IS,meshbasic_frag:FS,meshlambert_vert:DS,meshlambert_frag:US,meshmatcap_vert:NS,meshmatcap_frag:OS,meshnormal_vert:kS,meshnormal_frag:BS,meshphong_vert:zS,meshphong_frag:VS,meshphysical_vert:HS,meshphysical_frag:GS,meshtoon_vert:WS,meshtoon_frag:XS,points_vert:YS,points_frag:qS,shadow_vert:jS,shadow_frag:$S,sprite_vert:ZS,sprite_frag:KS},gt={common:{diffuse:{value:new re(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new te},alphaMap:{value:null},alphaMapTransform:{value:new te},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new te}},envmap:{envMap:{value:null},envMapRotation:{value:new te},flipEnvMap:{value:-1},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new te}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new te}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new te},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new te},normalScale:{value:new $t(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new te},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new te}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new te}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new te}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new re(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMap:{value:[]},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotShadowMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMap:{value:[]},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null}},points:{diffuse:{value:new re(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new te},alphaTest:{value:0},uvTransform:{value:new te}},sprite:{diffuse:{value:new re(16777215)},opacity:{value:1},center:{value:new $t(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new te},alphaMap:{value:null},alphaMapTransform:{value:new te},alphaTest:{value:0}}},zi={basic:{uniforms:Nn([gt.common,gt.specularmap,gt.envmap,gt.aomap,gt.lightmap,gt.fog]),vertexShader:ne.meshbasic_vert,fragmentShader:ne.meshbasic_frag},lambert:{uniforms:Nn([gt.common,gt.specularmap,gt.envmap,gt.aomap,gt.lightmap,gt.emissivemap,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.fog,gt.lights,{emissive:{value:new re(0)}}]),vertexShader:ne.meshlambert_vert,fragmentShader:ne.meshlambert_frag},phong:{uniforms:Nn([gt.common,gt.specularmap,gt.envmap,gt.aomap,gt.lightmap,gt.emissivemap,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.fog,gt.lights,{emissive:{value:new re(0)},specular:{value:new re(1118481)},shininess:{value:30}}]),vertexShader:ne.meshphong_vert,fragmentShader:ne.meshphong_frag},standard:{uniforms:Nn([gt.common,gt.envmap,gt.aomap,gt.lightmap,gt.emissivemap,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.roughnessmap,gt.metalnessmap,gt.fog,gt.lights,{emissive:{value:new re(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:ne.meshphysical_vert,fragmentShader:ne.meshphysical_frag},toon:{uniforms:Nn([gt.common,gt.aomap,gt.lightmap,gt.emissivemap,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.gradientmap,gt.fog,gt.lights,{emissive:{value:new re(0)}}]),vertexShader:ne.meshtoon_vert,fragmentShader:ne.meshtoon_frag},matcap:{uniforms:Nn([gt.common,gt.bumpmap,gt.normalmap,gt.displacementmap,gt.fog,{matcap:{value:null}}]),vertexShader:ne.meshmatcap_vert,fragmentShader:ne.meshmatcap_frag},points:{uniforms:Nn([gt.points,gt.fog]),vertexShader:ne.points_vert,fragmentShader:ne.points_frag},dashed:{uniforms:Nn([gt.common,gt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:ne.linedashed_vert,fragmentShader:ne.linedashed_frag},depth:{uniforms:Nn([gt.common,gt.displacementmap]),vertexShader:ne.depth_vert,fragmentShader:ne.depth_frag},normal:{uniforms:Nn([gt.common,gt.bumpmap,gt.normalmap,gt.displacementmap,{opacity:{value:1}}]),vertexShader:ne.meshnormal_vert,fragmentShader:ne.meshnormal_frag},sprite:{uniforms:Nn([gt.sprite,gt.fog]),vertexShader:ne.sprite_vert,fragmentShader:ne.sprite_frag},background:{uniforms:{uvTransform:{value:new te},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:ne.background_vert,fragmentShader:ne.background_frag},backgroundCube:{uniforms:{envMap:{value:null},flipEnvMap:{value:-1},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new te}},vertexShader:ne.backgroundCube_vert,fragmentShader:ne.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:ne.cube_vert,fragmentShader:ne.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:ne.equirect_vert,fragmentShader:ne.equirect_frag},distanceRGBA:{uniforms:Nn([gt.common,gt.displacementmap,{referencePosition:{value:new D},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:ne.distanceRGBA_vert,fragmentShader:ne.distanceRGBA_frag},shadow:{uniforms:Nn([gt.lights,gt.fog,{color:{value:new re(0)},opacity:{value:1}}]),vertexShader:ne.shadow_vert,fragmentShader:ne.shadow_frag}};zi.physical={uniforms:Nn([zi.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new te},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new te},clearcoatNormalScale:{value:new $t(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new te},dispersion:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new te},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new te},sheen:{value:0},sheenColor:{value:new re(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new te},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new te},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new te},transmissionSamplerSize:{value:new $t},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new te},attenuationDistance:{value:0},attenuationColor:{value:new re(0)},specularColor:{value:new re(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new te},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new te},anisotropyVector:{value:new $t},anisotropyMap:{value:null},anisotropyMapTransform:{value:new te}}]),vertexShader:ne.meshphysical_vert,fragmentShader:ne.meshphysical_frag};const za={r:0,b:0,g:0},js=new gs,JS=new Pe;function QS(i,t,e,n,s,r,o){const a=new re(0);let l=r===!0?0:1,c,h,f=null,u=0,p=null;function _(M){let w=M.isScene===!0?M.background:null;return w&&w.isTexture&&(w=(M.backgroundBlurriness>0?e:t).get(w)),w}function b(M){let w=!1;const v=_(M);v===null?d(a,l):v&&v.isColor&&(d(v,1),w=!0);const U=i.xr.getEnvironmentBlendMode();U==="additive"?n.buffers.color.setClear(0,0,0,1,o):U==="alpha-blend"&&n.buffers.color.setClear(0,0,0,0,o),(i.autoClear||w)&&(n.buffers.depth.setTest(!0),n.buffers.depth.setMask(!0),n.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function m(M,w){const v=_(w);v&&(v.isCubeTexture||v.mapping===Gl)?(h===void 0&&(h=new Ye(new Ao(1,1,1),new Hi({name:"BackgroundCubeMaterial",uniforms:Mo(zi.backgroundCube.uniforms),vertexShader:zi.backgroundCube.vertexShader,fragmentShader:zi.backgroundCube.fragmentShader,side:Cn,depthTest:!1,depthWrite:!1,fog:!1})),h.geometry.deleteAttribute("normal"),h.geometry.deleteAttribute("uv"),h.onBeforeRender=function(U,P,L){this.matrixWorld.copyPosition(L.matrixWorld)},Object.defineProperty(h.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),s.update(h)),js.copy(w.backgroundRotation),js.x*=-1,js.y*=-1,js.z*=-1,v.isCubeTexture&&v.isRenderTargetTexture===!1&&(js.y*=-1,js.z*=-1),h.material.uniforms.envMap.value=v,h.material.uniforms.flipEnvMap.value=v.isCubeTexture&&v.isRenderTargetTexture===!1?-1:1,h.material.uniforms.backgroundBlurriness.value=w.backgroundBlurriness,h.material.uniforms.backgroundIntensity.value=w.backgroundIntensity,h.material.uniforms.backgroundRotation.value.setFromMatrix4(JS.makeRotationFromEuler(js)),h.material.toneMapped=fe.getTransfer(v.colorSpace)!==Ae,(f!==v||u!==v.version||p!==i.toneMapping)&&(h.material.needsUpdate=!0,f=v,u=v.version,p=i.toneMapping),h.layers.enableAll(),M.unshift(h,h.geometry,h.material,0,0,null)):v&&v.isTexture&&(c===void 0&&(c=new Ye(new la(2,2),new Hi({name:"BackgroundMaterial",uniforms:Mo(zi.background.uniforms),vertexShader:zi.background.vertexShader,fragmentShader:zi.background.fragmentShader,side:Vi,depthTest:!1,depthWrite:!1,fog:!1})),c.geometry.deleteAttribute("normal"),Object.defineProperty(c.material,"map",{get:function(){return this.uniforms.t2D.value}}),s.update(c)),c.material.uniforms.t2D.value=v,c.material.uniforms.backgroundIntensity.value=w.backgroundIntensity,c.material.toneMapped=fe.getTransfer(v.colorSpace)!==Ae,v.matrixAutoUpdate===!0&&v.updateMatrix(),c.material.uniforms.uvTransform.value.copy(v.matrix),(f!==v||u!==v.version||p!==i.toneMapping)&&(c.material.needsUpdate=!0,f=v,u=v.version,p=i.toneMapping),c.layers.enableAll(),M.unshift(c,c.geometry,c.material,0,0,null))}function d(M,w){M.getRGB(za,w_(i)),n.buffers.color.setClear(za.r,za.g,za.b,w,o)}return{getClearColor:function(){return a},setClearColor:function(M,w=1){a.set(M),l=w,d(a,l)},getClearAlpha:function(){return l},setClearAlpha:function(M){l=M,d(a,l)},render:b,addToRenderList:m}}function tw(i,t){const e=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=u(null);let r=s,o=!1;function a(x,A,V,N,Y){let X=!1;const J=f(N,V,A);r!==J&&(r=J,c(r.object)),X=p(x,N,V,Y),X&&_(x,N,V,Y),Y!==null&&t.update(Y,i.ELEMENT_ARRAY_BUFFER),(X||o)&&(o=!1,v(x,A,V,N),Y!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,t.get(Y).buffer))}function l(){return i.createVertexArray()}function c(x){return i.bindVertexArray(x)}function h(x){return i.deleteVertexArray(x)}function f(x,A,V){const N=V.wireframe===!0;let Y=n[x.id];Y===void 0&&(Y={},n[x.id]=Y);let X=Y[A.id];X===void 0&&(X={},Y[A.id]=X);let J=X[N];return J===void 0&&(J=u(l()),X[N]=J),J}function u(x){const A=[],V=[],N=[];for(let Y=0;Y<e;Y++)A[Y]=0,V[Y]=0,N[Y]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:A,enabledAttributes:V,attributeDivisors:N,object:x,attributes:{},index:null}}function p(x,A,V,N){const Y=r.attributes,X=A.attributes;let J=0;const K=V.getAttributes();for(const et in K)if(K[et].location>=0){const ht=Y[et];let _t=X[et];if(_t===void 0&&(et==="instanceMatrix"&&x.instanceMatrix&&(_t=x.instanceMatrix),et==="instanceColor"&&x.instanceColor&&(_t=x.instanceColor)),ht===void 0||ht.attribute!==_t||_t&&ht.data!==_t.data)return!0;J++}return r.attributesNum!==J||r.index!==N}function _(x,A,V,N){const Y={},X=A.attributes;let J=0;const K=V.getAttributes();for(const et in K)if(K[et].location>=0){let ht=X[et];ht===void 0&&(et==="instanceMatrix"&&x.instanceMatrix&&(ht=x.instanceMatrix),et==="instanceColor"&&x.instanceColor&&(ht=x.instanceColor));const _t={};_t.attribute=ht,ht&&ht.data&&(_t.data=ht.data),Y[et]=_t,J++}r.attributes=Y,r.attributesNum=J,r.index=N}function b(){const x=r.newAttributes;for(let A=0,V=x.length;A<V;A++)x[A]=0}function m(x){d(x,0)}function d(x,A){const V=r.newAttributes,N=r.enabledAttributes,Y=r.attributeDivisors;V[x]=1,N[x]===0&&(i.enableVertexAttribArray(x),N[x]=1),Y[x]!==A&&(i.vertexAttribDivisor(x,A),Y[x]=A)}function M(){const x=r.newAttributes,A=r.enabledAttributes;for(let V=0,N=A.length;V<N;V++)A[V]!==x[V]&&(i.disableVertexAttribArray(V),A[V]=0)}function w(x,A,V,N,Y,X,J){J===!0?i.vertexAttribIPointer(x,A,V,Y,X):i.vertexAttribPointer(x,A,V,N,Y,X)}function v(x,A,V,N){b();const Y=N.attributes,X=V.getAttributes(),J=A.defaultAttributeValues;for(const K in X){const et=X[K];if(et.location>=0){let ct=Y[K];if(ct===void 0&&(K==="instanceMatrix"&&x.instanceMatrix&&(ct=x.instanceMatrix),K==="instanceColor"&&x.instanceColor&&(ct=x.instanceColor)),ct!==void 0){const ht=ct.normalized,_t=ct.itemSize,vt=t.get(ct);if(vt===void 0)continue;const pt=vt.buffer,st=vt.type,lt=vt.bytesPerElement,bt=st===i.INT||st===i.UNSIGNED_INT||ct.gpuType===Wl;if(ct.isInterleavedBufferAttribute){const at=ct.data,zt=at.stride,Ht=ct.offset;if(at.isInstancedInterleavedBuffer){for(let Ut=0;Ut<et.locationSize;Ut++)d(et.location+Ut,at.meshPerAttribute);x.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=at.meshPerAttribute*at.count)}else for(let Ut=0;Ut<et.locationSize;Ut++)m(et.location+Ut);i.bindBuffer(i.ARRAY_BUFFER,pt);for(let Ut=0;Ut<et.locationSize;Ut++)w(et.location+Ut,_t/et.locationSize,st,ht,zt*lt,(Ht+_t/et.locationSize*Ut)*lt,bt)}else{if(ct.isInstancedBufferAttribute){for(let at=0;at<et.locationSize;at++)d(et.location+at,ct.meshPerAttribute);x.isInstancedMesh!==!0&&N._maxInstanceCount===void 0&&(N._maxInstanceCount=ct.meshPerAttribute*ct.count)}else for(let at=0;at<et.locationSize;at++)m(et.location+at);i.bindBuffer(i.ARRAY_BUFFER,pt);for(let at=0;at<et.locationSize;at++)w(et.location+at,_t/et.locationSize,st,ht,_t*lt,_t/et.locationSize*at*lt,bt)}}else if(J!==void 0){const ht=J[K];if(ht!==void 0)switch(ht.length){case 2:i.vertexAttrib2fv(et.location,ht);break;case 3:i.vertexAttrib3fv(et.location,ht);break;case 4:i.vertexAttrib4fv(et.location,ht);break;default:i.vertexAttrib1fv(et.location,ht)}}}}M()}function U(){F();for(const x in n){const A=n[x];for(const V in A){const N=A[V];for(const Y in N)h(N[Y].object),delete N[Y];delete A[V]}delete n[x]}}function P(x){if(n[x.id]===void 0)return;const A=n[x.id];for(const V in A){const N=A[V];for(const Y in N)h(N[Y].object),delete N[Y];delete A[V]}delete n[x.id]}function L(x){for(const A in n){const V=n[A];if(V[x.id]===void 0)continue;const N=V[x.id];for(const Y in N)h(N[Y].object),delete N[Y];delete V[x.id]}}function F(){S(),o=!0,r!==s&&(r=s,c(r.object))}function S(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:F,resetDefaultState:S,dispose:U,releaseStatesOfGeometry:P,releaseStatesOfProgram:L,initAttributes:b,enableAttribute:m,disableUnusedAttributes:M}}function ew(i,t,e){let n;function s(c){n=c}function r(c,h){i.drawArrays(n,c,h),e.update(h,n,1)}function o(c,h,f){f!==0&&(i.drawArraysInstanced(n,c,h,f),e.update(h,n,f))}function a(c,h,f){if(f===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,c,0,h,0,f);let p=0;for(let _=0;_<f;_++)p+=h[_];e.update(p,n,1)}function l(c,h,f,u){if(f===0)return;const p=t.get("WEBGL_multi_draw");if(p===null)for(let _=0;_<c.length;_++)o(c[_],h[_],u[_]);else{p.multiDrawArraysInstancedWEBGL(n,c,0,h,0,u,0,f);let _=0;for(let b=0;b<f;b++)_+=h[b]*u[b];e.update(_,n,1)}}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a,this.renderMultiDrawInstances=l}function nw(i,t,e,n){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){const L=t.get("EXT_texture_filter_anisotropic");s=i.getParameter(L.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(L){return!(L!==Ai&&n.convert(L)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(L){const F=L===oa&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(L!==_s&&n.convert(L)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE)&&L!==Ti&&!F)}function l(L){if(L==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";L="mediump"}return L==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp";const h=l(c);h!==c&&(console.warn("THREE.WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);const f=e.logarithmicDepthBuffer===!0,u=e.reverseDepthBuffer===!0&&t.has("EXT_clip_control"),p=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),_=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),b=i.getParameter(i.MAX_TEXTURE_SIZE),m=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),d=i.getParameter(i.MAX_VERTEX_ATTRIBS),M=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),w=i.getParameter(i.MAX_VARYING_VECTORS),v=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),U=_>0,P=i.getParameter(i.MAX_SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:f,reverseDepthBuffer:u,maxTextures:p,maxVertexTextures:_,maxTextureSize:b,maxCubemapSize:m,maxAttributes:d,maxVertexUniforms:M,maxVaryings:w,maxFragmentUniforms:v,vertexTextures:U,maxSamples:P}}function iw(i){const t=this;let e=null,n=0,s=!1,r=!1;const o=new cs,a=new te,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(f,u){const p=f.length!==0||u||n!==0||s;return s=u,n=f.length,p},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(f,u){e=h(f,u,0)},this.setState=function(f,u,p){const _=f.clippingPlanes,b=f.clipIntersection,m=f.clipShadows,d=i.get(f);if(!s||_===null||_.length===0||r&&!m)r?h(null):c();else{const M=r?0:n,w=M*4;let v=d.clippingState||null;l.value=v,v=h(_,u,w,p);for(let U=0;U!==w;++U)v[U]=e[U];d.clippingState=v,this.numIntersection=b?this.numPlanes:0,this.numPlanes+=M}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=n>0),t.numPlanes=n,t.numIntersection=0}function h(f,u,p,_){const b=f!==null?f.length:0;let m=null;if(b!==0){if(m=l.value,_!==!0||m===null){const d=p+b*4,M=u.matrixWorldInverse;a.getNormalMatrix(M),(m===null||m.length<d)&&(m=new Float32Array(d));for(let w=0,v=p;w!==b;++w,v+=4)o.copy(f[w]).applyMatrix4(M,a),o.normal.toArray(m,v),m[v+3]=o.constant}l.value=m,l.needsUpdate=!0}return t.numPlanes=b,t.numIntersection=0,m}}function sw(i){let t=new WeakMap;function e(o,a){return a===Nh?o.mapping=_o:a===Oh&&(o.mapping=go),o}function n(o){if(o&&o.isTexture){const a=o.mapping;if(a===Nh||a===Oh)if(t.has(o)){const l=t.get(o).texture;return e(l,o.mapping)}else{const l=o.image;if(l&&l.height>0){const c=new mM(l.height);return c.fromEquirectangularTexture(i,o),t.set(o,c),o.addEventListener("dispose",s),e(c.texture,o.mapping)}else return null}}return o}function s(o){const a=o.target;a.removeEventListener("dispose",s);const l=t.get(a);l!==void 0&&(t.delete(a),l.dispose())}function r(){t=new WeakMap}return{get:n,dispose:r}}class A_ extends Yu{constructor(t=-1,e=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){const t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2;let r=n-t,o=n+t,a=s+e,l=s-e;if(this.view!==null&&this.view.enabled){const c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){const e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}}const no=4,Qd=[.125,.215,.35,.446,.526,.582],ar=20,Wc=new A_,tp=new re;let Xc=null,Yc=0,qc=0,jc=!1;const Js=(1+Math.sqrt(5))/2,qr=1/Js,ep=[new D(-Js,qr,0),new D(Js,qr,0),new D(-qr,0,Js),new D(qr,0,Js),new D(0,Js,-qr),new D(0,Js,qr),new D(-1,1,-1),new D(1,1,-1),new D(-1,1,1),new D(1,1,1)];class np{constructor(t){this._renderer=t,this._pingPongRenderTarget=null,this._lodMax=0,this._cubeSize=0,this._lodPlanes=[],this._sizeLods=[],this._sigmas=[],this._blurMaterial=null,this._cubemapMaterial=null,this._equirectMaterial=null,this._compileMaterial(this._blurMaterial)}fromScene(t,e=0,n=.1,s=100){Xc=this._renderer.getRenderTarget(),Yc=this._renderer.getActiveCubeFace(),qc=this._renderer.getActiveMipmapLevel(),jc=this._renderer.xr.enabled,this._renderer.xr.enabled=!1,this._setSize(256);const r=this._allocateTargets();return r.depthBuffer=!0,this._sceneToCubeUV(t,n,s,r),e>0&&this._blur(r,0,0,e),this._applyPMREM(r),this._cleanup(r),r}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=rp(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=sp(),this._compileMaterial(this._equirectMaterial))}dispose(){this._dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose()}_setSize(t){this._lodMax=Math.floor(Math.log2(t)),this._cubeSize=Math.pow(2,this._lodMax)}_dispose(){this._blurMaterial!==null&&this._blurMaterial.dispose(),this._pingPongRenderTarget!==null&&this._pingPongRenderTarget.dispose();for(let t=0;t<this._lodPlanes.length;t++)this._lodPlanes[t].dispose()}_cleanup(t){this._renderer.setRenderTarget(Xc,Yc,qc),this._renderer.xr.enabled=jc,t.scissorTest=!1,Va(t,0,0,t.width,t.height)}_fromTexture(t,e){t.mapping===_o||t.mapping===go?this._setSize(t.image.length===0?16:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4),Xc=this._renderer.getRenderTarget(),Yc=this._renderer.getActiveCubeFace(),qc=this._renderer.getActiveMipmapLevel(),jc=this._renderer.xr.enabled,this._renderer.xr.enabled=!1;const n=e||this._allocateTargets();return this._textureToCubeUV(t,n),this._applyPMREM(n),this._cleanup(n),n}_allocateTargets(){const t=3*Math.max(this._cubeSize,112),e=4*this._cubeSize,n={magFilter:Ei,minFilter:Ei,generateMipmaps:!1,type:oa,format:Ai,colorSpace:br,depthBuffer:!1},s=ip(t,e,n);if(this._pingPongRenderTarget===null||this._pingPongRenderTarget.width!==t||this._pingPongRenderTarget.height!==e){this._pingPongRenderTarget!==null&&this._dispose(),this._pingPongRenderTarget=ip(t,e,n);const{_lodMax:r}=this;({sizeLods:this._sizeLods,lodPlanes:this._lodPlanes,sigmas:this._sigmas}=rw(r)),this._blurMaterial=ow(r,t,e)}return s}_compileMaterial(t){const e=new Ye(this._lodPlanes[0],t);this._renderer.compile(e,Wc)}_sceneToCubeUV(t,e,n,s){const a=new hi(90,1,e,n),l=[1,-1,1,1,1,1],c=[1,1,1,-1,-1,-1],h=this._renderer,f=h.autoClear,u=h.toneMapping;h.getClearColor(tp),h.toneMapping=Is,h.autoClear=!1;const p=new jl({name:"PMREM.Background",side:Cn,depthWrite:!1,depthTest:!1}),_=new Ye(new Ao,p);let b=!1;const m=t.background;m?m.isColor&&(p.color.copy(m),t.background=null,b=!0):(p.color.copy(tp),b=!0);for(let d=0;d<6;d++){const M=d%3;M===0?(a.up.set(0,l[d],0),a.lookAt(c[d],0,0)):M===1?(a.up.set(0,0,l[d]),a.lookAt(0,c[d],0)):(a.up.set(0,l[d],0),a.lookAt(0,0,c[d]));const w=this._cubeSize;Va(s,M*w,d>2?w:0,w,w),h.setRenderTarget(s),b&&h.render(_,a),h.render(t,a)}_.geometry.dispose(),_.material.dispose(),h.toneMapping=u,h.autoClear=f,t.background=m}_textureToCubeUV(t,e){const n=this._renderer,s=t.mapping===_o||t.mapping===go;s?(this._cubemapMaterial===null&&(this._cubemapMaterial=rp()),this._cubemapMaterial.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):this._equirectMaterial===null&&(this._equirectMaterial=sp());const r=s?this._cubemapMaterial:this._equirectMaterial,o=new Ye(this._lodPlanes[0],r),a=r.uniforms;a.envMap.value=t;const l=this._cubeSize;Va(e,0,0,3*l,2*l),n.setRenderTarget(e),n.render(o,Wc)}_applyPMREM(t){const e=this._renderer,n=e.autoClear;e.autoClear=!1;const s=this._lodPlanes.length;for(let r=1;r<s;r++){const o=Math.sqrt(this._sigmas[r]*this._sigmas[r]-this._sigmas[r-1]*this._sigmas[r-1]),a=ep[(s-r-1)%ep.length];this._blur(t,r-1,r,o,a)}e.autoClear=n}_blur(t,e,n,s,r){const o=this._pingPongRenderTarget;this._halfBlur(t,o,e,n,s,"latitudinal",r),this._halfBlur(o,t,n,n,s,"longitudinal",r)}_halfBlur(t,e,n,s,r,o,a){const l=this._renderer,c=this._blurMaterial;o!=="latitudinal"&&o!=="longitudinal"&&console.error("blur direction must be either latitudinal or longitudinal!");const h=3,f=new Ye(this._lodPlanes[s],c),u=c.uniforms,p=this._sizeLods[n]-1,_=isFinite(r)?Math.PI/(2*p):2*Math.PI/(2*ar-1),b=r/_,m=isFinite(r)?1+Math.floor(h*b):ar;m>ar&&console.warn(`sigmaRadians, ${r}, is too large and will clip, as it requested ${m} samples when the maximum is set to ${ar}`);const d=[];let M=0;for(let L=0;L<ar;++L){const F=L/b,S=Math.exp(-F*F/2);d.push(S),L===0?M+=S:L<m&&(M+=2*S)}for(let L=0;L<d.length;L++)d[L]=d[L]/M;u.envMap.value=t.texture,u.samples.value=m,u.weights.value=d,u.latitudinal.value=o==="latitudinal",a&&(u.poleAxis.value=a);const{_lodMax:w}=this;u.dTheta.value=_,u.mipInt.value=w-n;const v=this._sizeLods[s],U=3*v*(s>w-no?s-w+no:0),P=4*(this._cubeSize-v);Va(e,U,P,3*v,2*v),l.setRenderTarget(e),l.render(f,Wc)}}function rw(i){const t=[],e=[],n=[];let s=i;const r=i-no+1+Qd.length;for(let o=0;o<r;o++){const a=Math.pow(2,s);e.push(a);let l=1/a;o>i-no?l=Qd[o-i+no-1]:o===0&&(l=0),n.push(l);const c=1/(a-2),h=-c,f=1+c,u=[h,h,f,h,f,f,h,h,f,f,h,f],p=6,_=6,b=3,m=2,d=1,M=new Float32Array(b*_*p),w=new Float32Array(m*_*p),v=new Float32Array(d*_*p);for(let P=0;P<p;P++){const L=P%3*2/3-1,F=P>2?0:-1,S=[L,F,0,L+2/3,F,0,L+2/3,F+1,0,L,F,0,L+2/3,F+1,0,L,F+1,0];M.set(S,b*_*P),w.set(u,m*_*P);const x=[P,P,P,P,P,P];v.set(x,d*_*P)}const U=new en;U.setAttribute("position",new Fe(M,b)),U.setAttribute("uv",new Fe(w,m)),U.setAttribute("faceIndex",new Fe(v,d)),t.push(U),s>no&&s--}return{lodPlanes:t,sizeLods:e,sigmas:n}}function ip(i,t,e){const n=new Ds(i,t,e);return n.texture.mapping=Gl,n.texture.name="PMREM.cubeUv",n.scissorTest=!0,n}function Va(i,t,e,n,s){i.viewport.set(t,e,n,s),i.scissor.set(t,e,n,s)}function ow(i,t,e){const n=new Float32Array(ar),s=new D(0,1,0);return new Hi({name:"SphericalGaussianBlur",defines:{n:ar,CUBEUV_TEXEL_WIDTH:1/t,CUBEUV_TEXEL_HEIGHT:1/e,CUBEUV_MAX_MIP:`${i}.0`},uniforms:{envMap:{value:null},samples:{value:1},weights:{value:n},latitudinal:{value:!1},dTheta:{value:0},mipInt:{value:0},poleAxis:{value:s}},vertexShader:ju(),fragmentShader:`

			precision mediump float;
			precision mediump int;

			varying vec3 vOutputDirection;

			uniform sampler2D envMap;
			uniform int samples;
			uniform float weights[ n ];
			uniform bool latitudinal;
			uniform float dTheta;
			uniform float mipInt;
			uniform vec3 poleAxis;

			#define ENVMAP_TYPE_CUBE_UV
			#include <cube_uv_reflection_fragment>

			vec3 getSample( float theta, vec3 axis ) {

				float cosTheta = cos( theta );
				// Rodrigues' axis-angle rotation
				vec3 sampleDirection = vOutputDirection * cosTheta
					+ cross( axis, vOutputDirection ) * sin( theta )
					+ axis * dot( axis, vOutputDirection ) * ( 1.0 - cosTheta );

				return bilinearCubeUV( envMap, sampleDirection, mipInt );

			}

			void main() {

				vec3 axis = latitudinal ? poleAxis : cross( poleAxis, vOutputDirection );

				if ( all( equal( axis, vec3( 0.0 ) ) ) ) {

					axis = vec3( vOutputDirection.z, 0.0, - vOutputDirection.x );

				}

				axis = normalize( axis );

				gl_FragColor = vec4( 0.0, 0.0, 0.0, 1.0 );
				gl_FragColor.rgb += weights[ 0 ] * getSample( 0.0, axis );

				for ( int i = 1; i < n; i++ ) {

					if ( i >= samples ) {

						break;

					}

					float theta = dTheta * float( i );
					gl_FragColor.rgb += weights[ i ] * getSample( -1.0 * theta, axis );
					gl_FragColor.rgb += weights[ i ] * getSample( theta, axis );

				}

			}
		`,blending:ps,depthTest:!1,depthWrite:!1})}function sp(){return new Hi({name:"EquirectangularToCubeUV",uniforms:{envMap:{value:null}},vertexShader:ju(),fragmentShader:`

			precision mediump float;
			precision mediump int;

			varying vec3 vOutputDirection;

			uniform sampler2D envMap;

			#include <common>

			void main() {

				vec3 outputDirection = normalize( vOutputDirection );
				vec2 uv = equirectUv( outputDirection );

				gl_FragColor = vec4( texture2D ( envMap, uv ).rgb, 1.0 );

			}
		`,blending:ps,depthTest:!1,depthWrite:!1})}function rp(){return new Hi({name:"CubemapToCubeUV",uniforms:{envMap:{value:null},flipEnvMap:{value:-1}},vertexShader:ju(),fragmentShader:`

			precision mediump float;
			precision mediump int;

			uniform float flipEnvMap;

			varying vec3 vOutputDirection;

			uniform samplerCube envMap;

			void main() {

				gl_FragColor = textureCube( envMap, vec3( flipEnvMap * vOutputDirection.x, vOutputDirection.yz ) );

			}
		`,blending:ps,depthTest:!1,depthWrite:!1})}function ju(){return`

		precision mediump float;
		precision mediump int;

		attribute float faceIndex;

		varying vec3 vOutputDirection;

		// RH coordinate system; PMREM face-indexing convention
		vec3 getDirection( vec2 uv, float face ) {

			uv = 2.0 * uv - 1.0;

			vec3 direction = vec3( uv, 1.0 );

			if ( face == 0.0 ) {

				direction = direction.zyx; // ( 1, v, u ) pos x

			} else if ( face == 1.0 ) {

				direction = direction.xzy;
				direction.xz *= -1.0; // ( -u, 1, -v ) pos y

			} else if ( face == 2.0 ) {

				direction.x *= -1.0; // ( -u, v, 1 ) pos z

			} else if ( face == 3.0 ) {

				direction = direction.zyx;
				direction.xz *= -1.0; // ( -1, v, -u ) neg x

			} else if ( face == 4.0 ) {

				direction = direction.xzy;
				direction.xy *= -1.0; // ( -u, -1, v ) neg y

			} else if ( face == 5.0 ) {

				direction.z *= -1.0; // ( u, v, -1 ) neg z

			}

			return direction;

		}

		void main() {

			vOutputDirection = getDirection( uv, faceIndex );
			gl_Position = vec4( position, 1.0 );

		}
	`}function aw(i){let t=new WeakMap,e=null;function n(a){if(a&&a.isTexture){const l=a.mapping,c=l===Nh||l===Oh,h=l===_o||l===go;if(c||h){let f=t.get(a);const u=f!==void 0?f.texture.pmremVersion:0;if(a.isRenderTargetTexture&&a.pmremVersion!==u)return e===null&&(e=new np(i)),f=c?e.fromEquirectangular(a,f):e.fromCubemap(a,f),f.texture.pmremVersion=a.pmremVersion,t.set(a,f),f.texture;if(f!==void 0)return f.texture;{const p=a.image;return c&&p&&p.height>0||h&&p&&s(p)?(e===null&&(e=new np(i)),f=c?e.fromEquirectangular(a):e.fromCubemap(a),f.texture.pmremVersion=a.pmremVersion,t.set(a,f),a.addEventListener("dispose",r),f.texture):null}}}return a}function s(a){let l=0;const c=6;for(let h=0;h<c;h++)a[h]!==void 0&&l++;return l===c}function r(a){const l=a.target;l.removeEventListener("dispose",r);const c=t.get(l);c!==void 0&&(t.delete(l),c.dispose())}function o(){t=new WeakMap,e!==null&&(e.dispose(),e=null)}return{get:n,dispose:o}}function lw(i){const t={};function e(n){if(t[n]!==void 0)return t[n];let s;switch(n){case"WEBGL_depth_texture":s=i.getExtension("WEBGL_depth_texture")||i.getExtension("MOZ_WEBGL_depth_texture")||i.getExtension("WEBKIT_WEBGL_depth_texture");break;case"EXT_texture_filter_anisotropic":s=i.getExtension("EXT_texture_filter_anisotropic")||i.getExtension("MOZ_EXT_texture_filter_anisotropic")||i.getExtension("WEBKIT_EXT_texture_filter_anisotropic");break;case"WEBGL_compressed_texture_s3tc":s=i.getExtension("WEBGL_compressed_texture_s3tc")||i.getExtension("MOZ_WEBGL_compressed_texture_s3tc")||i.getExtension("WEBKIT_WEBGL_compressed_texture_s3tc");break;case"WEBGL_compressed_texture_pvrtc":s=i.getExtension("WEBGL_compressed_texture_pvrtc")||i.getExtension("WEBKIT_WEBGL_compressed_texture_pvrtc");break;default:s=i.getExtension(n)}return t[n]=s,s}return{has:function(n){return e(n)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(n){const s=e(n);return s===null&&$o("THREE.WebGLRenderer: "+n+" extension not supported."),s}}}function cw(i,t,e,n){const s={},r=new WeakMap;function o(f){const u=f.target;u.index!==null&&t.remove(u.index);for(const _ in u.attributes)t.remove(u.attributes[_]);for(const _ in u.morphAttributes){const b=u.morphAttributes[_];for(let m=0,d=b.length;m<d;m++)t.remove(b[m])}u.removeEventListener("dispose",o),delete s[u.id];const p=r.get(u);p&&(t.remove(p),r.delete(u)),n.releaseStatesOfGeometry(u),u.isInstancedBufferGeometry===!0&&delete u._maxInstanceCount,e.memory.geometries--}function a(f,u){return s[u.id]===!0||(u.addEventListener("dispose",o),s[u.id]=!0,e.memory.geometries++),u}function l(f){const u=f.attributes;for(const _ in u)t.update(u[_],i.ARRAY_BUFFER);const p=f.morphAttributes;for(const _ in p){const b=p[_];for(let m=0,d=b.length;m<d;m++)t.update(b[m],i.ARRAY_BUFFER)}}function c(f){const u=[],p=f.index,_=f.attributes.position;let b=0;if(p!==null){const M=p.array;b=p.version;for(let w=0,v=M.length;w<v;w+=3){const U=M[w+0],P=M[w+1],L=M[w+2];u.push(U,P,P,L,L,U)}}else if(_!==void 0){const M=_.array;b=_.version;for(let w=0,v=M.length/3-1;w<v;w+=3){const U=w+0,P=w+1,L=w+2;u.push(U,P,P,L,L,U)}}else return;const m=new(g_(u)?S_:y_)(u,1);m.version=b;const d=r.get(f);d&&t.remove(d),r.set(f,m)}function h(f){const u=r.get(f);if(u){const p=f.index;p!==null&&u.version<p.version&&c(f)}else c(f);return r.get(f)}return{get:a,update:l,getWireframeAttribute:h}}function hw(i,t,e){let n;function s(u){n=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,p){i.drawElements(n,p,r,u*o),e.update(p,n,1)}function c(u,p,_){_!==0&&(i.drawElementsInstanced(n,p,r,u*o,_),e.update(p,n,_))}function h(u,p,_){if(_===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,p,0,r,u,0,_);let m=0;for(let d=0;d<_;d++)m+=p[d];e.update(m,n,1)}function f(u,p,_,b){if(_===0)return;const m=t.get("WEBGL_multi_draw");if(m===null)for(let d=0;d<u.length;d++)c(u[d]/o,p[d],b[d]);else{m.multiDrawElementsInstancedWEBGL(n,p,0,r,u,0,b,0,_);let d=0;for(let M=0;M<_;M++)d+=p[M]*b[M];e.update(d,n,1)}}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h,this.renderMultiDrawInstances=f}function uw(i){const t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(e.calls++,o){case i.TRIANGLES:e.triangles+=a*(r/3);break;case i.LINES:e.lines+=a*(r/2);break;case i.LINE_STRIP:e.lines+=a*(r-1);break;case i.LINE_LOOP:e.lines+=a*r;break;case i.POINTS:e.points+=a*r;break;default:console.error("THREE.WebGLInfo: Unknown draw mode:",o);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:n}}function fw(i,t,e){const n=new WeakMap,s=new He;function r(o,a,l){const c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,f=h!==void 0?h.length:0;let u=n.get(a);if(u===void 0||u.count!==f){let x=function(){F.dispose(),n.delete(a),a.removeEventListener("dispose",x)};var p=x;u!==void 0&&u.texture.dispose();const _=a.morphAttributes.position!==void 0,b=a.morphAttributes.normal!==void 0,m=a.morphAttributes.color!==void 0,d=a.morphAttributes.position||[],M=a.morphAttributes.normal||[],w=a.morphAttributes.color||[];let v=0;_===!0&&(v=1),b===!0&&(v=2),m===!0&&(v=3);let U=a.attributes.position.count*v,P=1;U>t.maxTextureSize&&(P=Math.ceil(U/t.maxTextureSize),U=t.maxTextureSize);const L=new Float32Array(U*P*4*f),F=new v_(L,U,P,f);F.type=Ti,F.needsUpdate=!0;const S=v*4;for(let A=0;A<f;A++){const V=d[A],N=M[A],Y=w[A],X=U*P*4*A;for(let J=0;J<V.count;J++){const K=J*S;_===!0&&(s.fromBufferAttribute(V,J),L[X+K+0]=s.x,L[X+K+1]=s.y,L[X+K+2]=s.z,L[X+K+3]=0),b===!0&&(s.fromBufferAttribute(N,J),L[X+K+4]=s.x,L[X+K+5]=s.y,L[X+K+6]=s.z,L[X+K+7]=0),m===!0&&(s.fromBufferAttribute(Y,J),L[X+K+8]=s.x,L[X+K+9]=s.y,L[X+K+10]=s.z,L[X+K+11]=Y.itemSize===4?s.w:1)}}u={count:f,texture:F,size:new $t(U,P)},n.set(a,u),a.addEventListener("dispose",x)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,e);else{let _=0;for(let m=0;m<c.length;m++)_+=c[m];const b=a.morphTargetsRelative?1:1-_;l.getUniforms().setValue(i,"morphTargetBaseInfluence",b),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",u.texture,e),l.getUniforms().setValue(i,"morphTargetsTextureSize",u.size)}return{update:r}}function dw(i,t,e,n){let s=new WeakMap;function r(l){const c=n.render.frame,h=l.geometry,f=t.get(l,h);if(s.get(f)!==c&&(t.update(f),s.set(f,c)),l.isInstancedMesh&&(l.hasEventListener("dispose",a)===!1&&l.addEventListener("dispose",a),s.get(l)!==c&&(e.update(l.instanceMatrix,i.ARRAY_BUFFER),l.instanceColor!==null&&e.update(l.instanceColor,i.ARRAY_BUFFER),s.set(l,c))),l.isSkinnedMesh){const u=l.skeleton;s.get(u)!==c&&(u.update(),s.set(u,c))}return f}function o(){s=new WeakMap}function a(l){const c=l.target;c.removeEventListener("dispose",a),e.remove(c.instanceMatrix),c.instanceColor!==null&&e.remove(c.instanceColor)}return{update:r,dispose:o}}class R_ extends zn{constructor(t,e,n,s,r,o,a,l,c,h=oo){if(h!==oo&&h!==vo)throw new Error("DepthTexture format must be either THREE.DepthFormat or THREE.DepthStencilFormat");n===void 0&&h===oo&&(n=mr),n===void 0&&h===vo&&(n=bo),super(null,s,r,o,a,l,h,n,c),this.isDepthTexture=!0,this.image={width:t,height:e},this.magFilter=a!==void 0?a:Ln,this.minFilter=l!==void 0?l:Ln,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.compareFunction=t.compareFunction,this}toJSON(t){const e=super.toJSON(t);return this.compareFunction!==null&&(e.compareFunction=this.compareFunction),e}}const P_=new zn,op=new R_(1,1),C_=new v_,L_=new tM,I_=new E_,ap=[],lp=[],cp=new Float32Array(16),hp=new Float32Array(9),up=new Float32Array(4);function Ro(i,t,e){const n=i[0];if(n<=0||n>0)return i;const s=t*e;let r=ap[s];if(r===void 0&&(r=new Float32Array(s),ap[s]=r),t!==0){n.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,i[o].toArray(r,a)}return r}function hn(i,t){if(i.length!==t.length)return!1;for(let e=0,n=i.length;e<n;e++)if(i[e]!==t[e])return!1;return!0}function un(i,t){for(let e=0,n=t.length;e<n;e++)i[e]=t[e]}function $l(i,t){let e=lp[t];e===void 0&&(e=new Int32Array(t),lp[t]=e);for(let n=0;n!==t;++n)e[n]=i.allocateTextureUnit();return e}function pw(i,t){const e=this.cache;e[0]!==t&&(i.uniform1f(this.addr,t),e[0]=t)}function mw(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(hn(e,t))return;i.uniform2fv(this.addr,t),un(e,t)}}function _w(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(i.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(hn(e,t))return;i.uniform3fv(this.addr,t),un(e,t)}}function gw(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(hn(e,t))return;i.uniform4fv(this.addr,t),un(e,t)}}function bw(i,t){const e=this.cache,n=t.elements;if(n===void 0){if(hn(e,t))return;i.uniformMatrix2fv(this.addr,!1,t),un(e,t)}else{if(hn(e,n))return;up.set(n),i.uniformMatrix2fv(this.addr,!1,up),un(e,n)}}function vw(i,t){const e=this.cache,n=t.elements;if(n===void 0){if(hn(e,t))return;i.uniformMatrix3fv(this.addr,!1,t),un(e,t)}else{if(hn(e,n))return;hp.set(n),i.uniformMatrix3fv(this.addr,!1,hp),un(e,n)}}function xw(i,t){const e=this.cache,n=t.elements;if(n===void 0){if(hn(e,t))return;i.uniformMatrix4fv(this.addr,!1,t),un(e,t)}else{if(hn(e,n))return;cp.set(n),i.uniformMatrix4fv(this.addr,!1,cp),un(e,n)}}function Mw(i,t){const e=this.cache;e[0]!==t&&(i.uniform1i(this.addr,t),e[0]=t)}function yw(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(hn(e,t))return;i.uniform2iv(this.addr,t),un(e,t)}}function Sw(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(hn(e,t))return;i.uniform3iv(this.addr,t),un(e,t)}}function ww(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(hn(e,t))return;i.uniform4iv(this.addr,t),un(e,t)}}function Ew(i,t){const e=this.cache;e[0]!==t&&(i.uniform1ui(this.addr,t),e[0]=t)}function Tw(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(hn(e,t))return;i.uniform2uiv(this.addr,t),un(e,t)}}function Aw(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(hn(e,t))return;i.uniform3uiv(this.addr,t),un(e,t)}}function Rw(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(hn(e,t))return;i.uniform4uiv(this.addr,t),un(e,t)}}function Pw(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?(op.compareFunction=__,r=op):r=P_,e.setTexture2D(t||r,s)}function Cw(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture3D(t||L_,s)}function Lw(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTextureCube(t||I_,s)}function Iw(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture2DArray(t||C_,s)}function Fw(i){switch(i){case 5126:return pw;case 35664:return mw;case 35665:return _w;case 35666:return gw;case 35674:return bw;case 35675:return vw;case 35676:return xw;case 5124:case 35670:return Mw;case 35667:case 35671:return yw;case 35668:case 35672:return Sw;case 35669:case 35673:return ww;case 5125:return Ew;case 36294:return Tw;case 36295:return Aw;case 36296:return Rw;case 35678:case 36198:case 36298:case 36306:case 35682:return Pw;case 35679:case 36299:case 36307:return Cw;case 35680:case 36300:case 36308:case 36293:return Lw;case 36289:case 36303:case 36311:case 36292:return Iw}}function Dw(i,t){i.uniform1fv(this.addr,t)}function Uw(i,t){const e=Ro(t,this.size,2);i.uniform2fv(this.addr,e)}function Nw(i,t){const e=Ro(t,this.size,3);i.uniform3fv(this.addr,e)}function Ow(i,t){const e=Ro(t,this.size,4);i.uniform4fv(this.addr,e)}function kw(i,t){const e=Ro(t,this.size,4);i.uniformMatrix2fv(this.addr,!1,e)}function Bw(i,t){const e=Ro(t,this.size,9);i.uniformMatrix3fv(this.addr,!1,e)}function zw(i,t){const e=Ro(t,this.size,16);i.uniformMatrix4fv(this.addr,!1,e)}function Vw(i,t){i.uniform1iv(this.addr,t)}function Hw(i,t){i.uniform2iv(this.addr,t)}function Gw(i,t){i.uniform3iv(this.addr,t)}function Ww(i,t){i.uniform4iv(this.addr,t)}function Xw(i,t){i.uniform1uiv(this.addr,t)}function Yw(i,t){i.uniform2uiv(this.addr,t)}function qw(i,t){i.uniform3uiv(this.addr,t)}function jw(i,t){i.uniform4uiv(this.addr,t)}function $w(i,t,e){const n=this.cache,s=t.length,r=$l(e,s);hn(n,r)||(i.uniform1iv(this.addr,r),un(n,r));for(let o=0;o!==s;++o)e.setTexture2D(t[o]||P_,r[o])}function Zw(i,t,e){const n=this.cache,s=t.length,r=$l(e,s);hn(n,r)||(i.uniform1iv(this.addr,r),un(n,r));for(let o=0;o!==s;++o)e.setTexture3D(t[o]||L_,r[o])}function Kw(i,t,e){const n=this.cache,s=t.length,r=$l(e,s);hn(n,r)||(i.uniform1iv(this.addr,r),un(n,r));for(let o=0;o!==s;++o)e.setTextureCube(t[o]||I_,r[o])}function Jw(i,t,e){const n=this.cache,s=t.length,r=$l(e,s);hn(n,r)||(i.uniform1iv(this.addr,r),un(n,r));for(let o=0;o!==s;++o)e.setTexture2DArray(t[o]||C_,r[o])}function Qw(i){switch(i){case 5126:return Dw;case 35664:return Uw;case 35665:return Nw;case 35666:return Ow;case 35674:return kw;case 35675:return Bw;case 35676:return zw;case 5124:case 35670:return Vw;case 35667:case 35671:return Hw;case 35668:case 35672:return Gw;case 35669:case 35673:return Ww;case 5125:return Xw;case 36294:return Yw;case 36295:return qw;case 36296:return jw;case 35678:case 36198:case 36298:case 36306:case 35682:return $w;case 35679:case 36299:case 36307:return Zw;case 35680:case 36300:case 36308:case 36293:return Kw;case 36289:case 36303:case 36311:case 36292:return Jw}}class tE{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.setValue=Fw(e.type)}}class eE{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=Qw(e.type)}}class nE{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,n){const s=this.seq;for(let r=0,o=s.length;r!==o;++r){const a=s[r];a.setValue(t,e[a.id],n)}}}const $c=/(\w+)(\])?(\[|\.)?/g;function fp(i,t){i.seq.push(t),i.map[t.id]=t}function iE(i,t,e){const n=i.name,s=n.length;for($c.lastIndex=0;;){const r=$c.exec(n),o=$c.lastIndex;let a=r[1];const l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){fp(e,c===void 0?new tE(a,i,t):new eE(a,i,t));break}else{let f=e.map[a];f===void 0&&(f=new nE(a),fp(e,f)),e=f}}}class ll{constructor(t,e){this.seq=[],this.map={};const n=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let s=0;s<n;++s){const r=t.getActiveUniform(e,s),o=t.getUniformLocation(e,r.name);iE(r,o,this)}}setValue(t,e,n,s){const r=this.map[e];r!==void 0&&r.setValue(t,n,s)}setOptional(t,e,n){const s=e[n];s!==void 0&&this.setValue(t,n,s)}static upload(t,e,n,s){for(let r=0,o=e.length;r!==o;++r){const a=e[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(t,l.value,s)}}static seqWithValue(t,e){const n=[];for(let s=0,r=t.length;s!==r;++s){const o=t[s];o.id in e&&n.push(o)}return n}}function dp(i,t,e){const n=i.createShader(t);return i.shaderSource(n,e),i.compileShader(n),n}const sE=37297;let rE=0;function oE(i,t){const e=i.split(`
`),n=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=s;o<r;o++){const a=o+1;n.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return n.join(`
`)}const pp=new te;function aE(i){fe._getMatrix(pp,fe.workingColorSpace,i);const t=`mat3( ${pp.elements.map(e=>e.toFixed(4))} )`;switch(fe.getTransfer(i)){case Yl:return[t,"LinearTransferOETF"];case Ae:return[t,"sRGBTransferOETF"];default:return console.warn("THREE.WebGLProgram: Unsupported color space: ",i),[t,"LinearTransferOETF"]}}function mp(i,t,e){const n=i.getShaderParameter(t,i.COMPILE_STATUS),s=i.getShaderInfoLog(t).trim();if(n&&s==="")return"";const r=/ERROR: 0:(\d+)/.exec(s);if(r){const o=parseInt(r[1]);return e.toUpperCase()+`

`+s+`

`+oE(i.getShaderSource(t),o)}else return s}function lE(i,t){const e=aE(t);return[`vec4 ${i}( vec4 value ) {`,`	return ${e[1]}( vec4( value.rgb * ${e[0]}, value.a ) );`,"}"].join(`
`)}function cE(i,t){let e;switch(t){case Mx:e="Linear";break;case yx:e="Reinhard";break;case Sx:e="Cineon";break;case wx:e="ACESFilmic";break;case Tx:e="AgX";break;case Ax:e="Neutral";break;case Ex:e="Custom";break;default:console.warn("THREE.WebGLProgram: Unsupported toneMapping:",t),e="Linear"}return"vec3 "+i+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}const Ha=new D;function hE(){fe.getLuminanceCoefficients(Ha);const i=Ha.x.toFixed(4),t=Ha.y.toFixed(4),e=Ha.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function uE(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Zo).join(`
`)}function fE(i){const t=[];for(const e in i){const n=i[e];n!==!1&&t.push("#define "+e+" "+n)}return t.join(`
`)}function dE(i,t){const e={},n=i.getProgramParameter(t,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){const r=i.getActiveAttrib(t,s),o=r.name;let a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:i.getAttribLocation(t,o),locationSize:a}}return e}function Zo(i){return i!==""}function _p(i,t){const e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return i.replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows)}function gp(i,t){return i.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}const pE=/^[ \t]*#include +<([\w\d./]+)>/gm;function du(i){return i.replace(pE,_E)}const mE=new Map;function _E(i,t){let e=ne[t];if(e===void 0){const n=mE.get(t);if(n!==void 0)e=ne[n],console.warn('THREE.WebGLRenderer: Shader chunk "%s" has been deprecated. Use "%s" instead.',t,n);else throw new Error("Can not resolve #include <"+t+">")}return du(e)}const gE=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function bp(i){return i.replace(gE,bE)}function bE(i,t,e,n){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function vp(i){let t=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?t+=`
#define HIGH_PRECISION`:i.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}function vE(i){let t="SHADOWMAP_TYPE_BASIC";return i.shadowMapType===o_?t="SHADOWMAP_TYPE_PCF":i.shadowMapType===tx?t="SHADOWMAP_TYPE_PCF_SOFT":i.shadowMapType===Ji&&(t="SHADOWMAP_TYPE_VSM"),t}function xE(i){let t="ENVMAP_TYPE_CUBE";if(i.envMap)switch(i.envMapMode){case _o:case go:t="ENVMAP_TYPE_CUBE";break;case Gl:t="ENVMAP_TYPE_CUBE_UV";break}return t}function ME(i){let t="ENVMAP_MODE_REFLECTION";if(i.envMap)switch(i.envMapMode){case go:t="ENVMAP_MODE_REFRACTION";break}return t}function yE(i){let t="ENVMAP_BLENDING_NONE";if(i.envMap)switch(i.combine){case ku:t="ENVMAP_BLENDING_MULTIPLY";break;case vx:t="ENVMAP_BLENDING_MIX";break;case xx:t="ENVMAP_BLENDING_ADD";break}return t}function SE(i){const t=i.envMapCubeUVHeight;if(t===null)return null;const e=Math.log2(t)-2,n=1/t;return{texelWidth:1/(3*Math.max(Math.pow(2,e),112)),texelHeight:n,maxMip:e}}function wE(i,t,e,n){const s=i.getContext(),r=e.defines;let o=e.vertexShader,a=e.fragmentShader;const l=vE(e),c=xE(e),h=ME(e),f=yE(e),u=SE(e),p=uE(e),_=fE(r),b=s.createProgram();let m,d,M=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(m=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,_].filter(Zo).join(`
`),m.length>0&&(m+=`
`),d=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,_].filter(Zo).join(`
`),d.length>0&&(d+=`
`)):(m=[vp(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,_,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGDEPTHBUF":"",e.reverseDepthBuffer?"#define USE_REVERSEDEPTHBUF":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Zo).join(`
`),d=[vp(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,_,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+h:"",e.envMap?"#define "+f:"",u?"#define CUBEUV_TEXEL_WIDTH "+u.texelWidth:"",u?"#define CUBEUV_TEXEL_HEIGHT "+u.texelHeight:"",u?"#define CUBEUV_MAX_MIP "+u.maxMip+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor||e.batchingColor?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGDEPTHBUF":"",e.reverseDepthBuffer?"#define USE_REVERSEDEPTHBUF":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==Is?"#define TONE_MAPPING":"",e.toneMapping!==Is?ne.tonemapping_pars_fragment:"",e.toneMapping!==Is?cE("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",ne.colorspace_pars_fragment,lE("linearToOutputTexel",e.outputColorSpace),hE(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(Zo).join(`
`)),o=du(o),o=_p(o,e),o=gp(o,e),a=du(a),a=_p(a,e),a=gp(a,e),o=bp(o),a=bp(a),e.isRawShaderMaterial!==!0&&(M=`#version 300 es
`,m=[p,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+m,d=["#define varying in",e.glslVersion===xo?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===xo?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+d);const w=M+m+o,v=M+d+a,U=dp(s,s.VERTEX_SHADER,w),P=dp(s,s.FRAGMENT_SHADER,v);s.attachShader(b,U),s.attachShader(b,P),e.index0AttributeName!==void 0?s.bindAttribLocation(b,0,e.index0AttributeName):e.morphTargets===!0&&s.bindAttribLocation(b,0,"position"),s.linkProgram(b);function L(A){if(i.debug.checkShaderErrors){const V=s.getProgramInfoLog(b).trim(),N=s.getShaderInfoLog(U).trim(),Y=s.getShaderInfoLog(P).trim();let X=!0,J=!0;if(s.getProgramParameter(b,s.LINK_STATUS)===!1)if(X=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,b,U,P);else{const K=mp(s,U,"vertex"),et=mp(s,P,"fragment");console.error("THREE.WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(b,s.VALIDATE_STATUS)+`

Material Name: `+A.name+`
Material Type: `+A.type+`

Program Info Log: `+V+`
`+K+`
`+et)}else V!==""?console.warn("THREE.WebGLProgram: Program Info Log:",V):(N===""||Y==="")&&(J=!1);J&&(A.diagnostics={runnable:X,programLog:V,vertexShader:{log:N,prefix:m},fragmentShader:{log:Y,prefix:d}})}s.deleteShader(U),s.deleteShader(P),F=new ll(s,b),S=dE(s,b)}let F;this.getUniforms=function(){return F===void 0&&L(this),F};let S;this.getAttributes=function(){return S===void 0&&L(this),S};let x=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return x===!1&&(x=s.getProgramParameter(b,sE)),x},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(b),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=rE++,this.cacheKey=t,this.usedTimes=1,this.program=b,this.vertexShader=U,this.fragmentShader=P,this}let EE=0;class TE{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t){const e=t.vertexShader,n=t.fragmentShader,s=this._getShaderStage(e),r=this._getShaderStage(n),o=this._getShaderCacheForMaterial(t);return o.has(s)===!1&&(o.add(s),s.usedTimes++),o.has(r)===!1&&(o.add(r),r.usedTimes++),this}remove(t){const e=this.materialCache.get(t);for(const n of e)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(t),this}getVertexShaderID(t){return this._getShaderStage(t.vertexShader).id}getFragmentShaderID(t){return this._getShaderStage(t.fragmentShader).id}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){const e=this.materialCache;let n=e.get(t);return n===void 0&&(n=new Set,e.set(t,n)),n}_getShaderStage(t){const e=this.shaderCache;let n=e.get(t);return n===void 0&&(n=new AE(t),e.set(t,n)),n}}class AE{constructor(t){this.id=EE++,this.code=t,this.usedTimes=0}}function RE(i,t,e,n,s,r,o){const a=new x_,l=new TE,c=new Set,h=[],f=s.logarithmicDepthBuffer,u=s.vertexTextures;let p=s.precision;const _={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distanceRGBA",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function b(S){return c.add(S),S===0?"uv":`uv${S}`}function m(S,x,A,V,N){const Y=V.fog,X=N.geometry,J=S.isMeshStandardMaterial?V.environment:null,K=(S.isMeshStandardMaterial?e:t).get(S.envMap||J),et=K&&K.mapping===Gl?K.image.height:null,ct=_[S.type];S.precision!==null&&(p=s.getMaxPrecision(S.precision),p!==S.precision&&console.warn("THREE.WebGLProgram.getParameters:",S.precision,"not supported, using",p,"instead."));const ht=X.morphAttributes.position||X.morphAttributes.normal||X.morphAttributes.color,_t=ht!==void 0?ht.length:0;let vt=0;X.morphAttributes.position!==void 0&&(vt=1),X.morphAttributes.normal!==void 0&&(vt=2),X.morphAttributes.color!==void 0&&(vt=3);let pt,st,lt,bt;if(ct){const be=zi[ct];pt=be.vertexShader,st=be.fragmentShader}else pt=S.vertexShader,st=S.fragmentShader,l.update(S),lt=l.getVertexShaderID(S),bt=l.getFragmentShaderID(S);const at=i.getRenderTarget(),zt=i.state.buffers.depth.getReversed(),Ht=N.isInstancedMesh===!0,Ut=N.isBatchedMesh===!0,ce=!!S.map,Kt=!!S.matcap,he=!!K,H=!!S.aoMap,nn=!!S.lightMap,Qt=!!S.bumpMap,ee=!!S.normalMap,Gt=!!S.displacementMap,de=!!S.emissiveMap,Lt=!!S.metalnessMap,C=!!S.roughnessMap,E=S.anisotropy>0,Z=S.clearcoat>0,Q=S.dispersion>0,W=S.iridescence>0,nt=S.sheen>0,St=S.transmission>0,xt=E&&!!S.anisotropyMap,Tt=Z&&!!S.clearcoatMap,Zt=Z&&!!S.clearcoatNormalMap,dt=Z&&!!S.clearcoatRoughnessMap,Mt=W&&!!S.iridescenceMap,Nt=W&&!!S.iridescenceThicknessMap,kt=nt&&!!S.sheenColorMap,Et=nt&&!!S.sheenRoughnessMap,ie=!!S.specularMap,qt=!!S.specularColorMap,pe=!!S.specularIntensityMap,z=St&&!!S.transmissionMap,yt=St&&!!S.thicknessMap,it=!!S.gradientMap,ot=!!S.alphaMap,At=S.alphaTest>0,Rt=!!S.alphaHash,Jt=!!S.extensions;let Be=Is;S.toneMapped&&(at===null||at.isXRRenderTarget===!0)&&(Be=i.toneMapping);const dn={shaderID:ct,shaderType:S.type,shaderName:S.name,vertexShader:pt,fragmentShader:st,defines:S.defines,customVertexShaderID:lt,customFragmentShaderID:bt,isRawShaderMaterial:S.isRawShaderMaterial===!0,glslVersion:S.glslVersion,precision:p,batching:Ut,batchingColor:Ut&&N._colorsTexture!==null,instancing:Ht,instancingColor:Ht&&N.instanceColor!==null,instancingMorph:Ht&&N.morphTexture!==null,supportsVertexTextures:u,outputColorSpace:at===null?i.outputColorSpace:at.isXRRenderTarget===!0?at.texture.colorSpace:br,alphaToCoverage:!!S.alphaToCoverage,map:ce,matcap:Kt,envMap:he,envMapMode:he&&K.mapping,envMapCubeUVHeight:et,aoMap:H,lightMap:nn,bumpMap:Qt,normalMap:ee,displacementMap:u&&Gt,emissiveMap:de,normalMapObjectSpace:ee&&S.normalMapType===Ix,normalMapTangentSpace:ee&&S.normalMapType===Lx,metalnessMap:Lt,roughnessMap:C,anisotropy:E,anisotropyMap:xt,clearcoat:Z,clearcoatMap:Tt,clearcoatNormalMap:Zt,clearcoatRoughnessMap:dt,dispersion:Q,iridescence:W,iridescenceMap:Mt,iridescenceThicknessMap:Nt,sheen:nt,sheenColorMap:kt,sheenRoughnessMap:Et,specularMap:ie,specularColorMap:qt,specularIntensityMap:pe,transmission:St,transmissionMap:z,thicknessMap:yt,gradientMap:it,opaque:S.transparent===!1&&S.blending===ro&&S.alphaToCoverage===!1,alphaMap:ot,alphaTest:At,alphaHash:Rt,combine:S.combine,mapUv:ce&&b(S.map.channel),aoMapUv:H&&b(S.aoMap.channel),lightMapUv:nn&&b(S.lightMap.channel),bumpMapUv:Qt&&b(S.bumpMap.channel),normalMapUv:ee&&b(S.normalMap.channel),displacementMapUv:Gt&&b(S.displacementMap.channel),emissiveMapUv:de&&b(S.emissiveMap.channel),metalnessMapUv:Lt&&b(S.metalnessMap.channel),roughnessMapUv:C&&b(S.roughnessMap.channel),anisotropyMapUv:xt&&b(S.anisotropyMap.channel),clearcoatMapUv:Tt&&b(S.clearcoatMap.channel),clearcoatNormalMapUv:Zt&&b(S.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:dt&&b(S.clearcoatRoughnessMap.channel),iridescenceMapUv:Mt&&b(S.iridescenceMap.channel),iridescenceThicknessMapUv:Nt&&b(S.iridescenceThicknessMap.channel),sheenColorMapUv:kt&&b(S.sheenColorMap.channel),sheenRoughnessMapUv:Et&&b(S.sheenRoughnessMap.channel),specularMapUv:ie&&b(S.specularMap.channel),specularColorMapUv:qt&&b(S.specularColorMap.channel),specularIntensityMapUv:pe&&b(S.specularIntensityMap.channel),transmissionMapUv:z&&b(S.transmissionMap.channel),thicknessMapUv:yt&&b(S.thicknessMap.channel),alphaMapUv:ot&&b(S.alphaMap.channel),vertexTangents:!!X.attributes.tangent&&(ee||E),vertexColors:S.vertexColors,vertexAlphas:S.vertexColors===!0&&!!X.attributes.color&&X.attributes.color.itemSize===4,pointsUvs:N.isPoints===!0&&!!X.attributes.uv&&(ce||ot),fog:!!Y,useFog:S.fog===!0,fogExp2:!!Y&&Y.isFogExp2,flatShading:S.flatShading===!0,sizeAttenuation:S.sizeAttenuation===!0,logarithmicDepthBuffer:f,reverseDepthBuffer:zt,skinning:N.isSkinnedMesh===!0,morphTargets:X.morphAttributes.position!==void 0,morphNormals:X.morphAttributes.normal!==void 0,morphColors:X.morphAttributes.color!==void 0,morphTargetsCount:_t,morphTextureStride:vt,numDirLights:x.directional.length,numPointLights:x.point.length,numSpotLights:x.spot.length,numSpotLightMaps:x.spotLightMap.length,numRectAreaLights:x.rectArea.length,numHemiLights:x.hemi.length,numDirLightShadows:x.directionalShadowMap.length,numPointLightShadows:x.pointShadowMap.length,numSpotLightShadows:x.spotShadowMap.length,numSpotLightShadowsWithMaps:x.numSpotLightShadowsWithMaps,numLightProbes:x.numLightProbes,numClippingPlanes:o.numPlanes,numClipIntersection:o.numIntersection,dithering:S.dithering,shadowMapEnabled:i.shadowMap.enabled&&A.length>0,shadowMapType:i.shadowMap.type,toneMapping:Be,decodeVideoTexture:ce&&S.map.isVideoTexture===!0&&fe.getTransfer(S.map.colorSpace)===Ae,decodeVideoTextureEmissive:de&&S.emissiveMap.isVideoTexture===!0&&fe.getTransfer(S.emissiveMap.colorSpace)===Ae,premultipliedAlpha:S.premultipliedAlpha,doubleSided:S.side===ui,flipSided:S.side===Cn,useDepthPacking:S.depthPacking>=0,depthPacking:S.depthPacking||0,index0AttributeName:S.index0AttributeName,extensionClipCullDistance:Jt&&S.extensions.clipCullDistance===!0&&n.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Jt&&S.extensions.multiDraw===!0||Ut)&&n.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:n.has("KHR_parallel_shader_compile"),customProgramCacheKey:S.customProgramCacheKey()};return dn.vertexUv1s=c.has(1),dn.vertexUv2s=c.has(2),dn.vertexUv3s=c.has(3),c.clear(),dn}function d(S){const x=[];if(S.shaderID?x.push(S.shaderID):(x.push(S.customVertexShaderID),x.push(S.customFragmentShaderID)),S.defines!==void 0)for(const A in S.defines)x.push(A),x.push(S.defines[A]);return S.isRawShaderMaterial===!1&&(M(x,S),w(x,S),x.push(i.outputColorSpace)),x.push(S.customProgramCacheKey),x.join()}function M(S,x){S.push(x.precision),S.push(x.outputColorSpace),S.push(x.envMapMode),S.push(x.envMapCubeUVHeight),S.push(x.mapUv),S.push(x.alphaMapUv),S.push(x.lightMapUv),S.push(x.aoMapUv),S.push(x.bumpMapUv),S.push(x.normalMapUv),S.push(x.displacementMapUv),S.push(x.emissiveMapUv),S.push(x.metalnessMapUv),S.push(x.roughnessMapUv),S.push(x.anisotropyMapUv),S.push(x.clearcoatMapUv),S.push(x.clearcoatNormalMapUv),S.push(x.clearcoatRoughnessMapUv),S.push(x.iridescenceMapUv),S.push(x.iridescenceThicknessMapUv),S.push(x.sheenColorMapUv),S.push(x.sheenRoughnessMapUv),S.push(x.specularMapUv),S.push(x.specularColorMapUv),S.push(x.specularIntensityMapUv),S.push(x.transmissionMapUv),S.push(x.thicknessMapUv),S.push(x.combine),S.push(x.fogExp2),S.push(x.sizeAttenuation),S.push(x.morphTargetsCount),S.push(x.morphAttributeCount),S.push(x.numDirLights),S.push(x.numPointLights),S.push(x.numSpotLights),S.push(x.numSpotLightMaps),S.push(x.numHemiLights),S.push(x.numRectAreaLights),S.push(x.numDirLightShadows),S.push(x.numPointLightShadows),S.push(x.numSpotLightShadows),S.push(x.numSpotLightShadowsWithMaps),S.push(x.numLightProbes),S.push(x.shadowMapType),S.push(x.toneMapping),S.push(x.numClippingPlanes),S.push(x.numClipIntersection),S.push(x.depthPacking)}function w(S,x){a.disableAll(),x.supportsVertexTextures&&a.enable(0),x.instancing&&a.enable(1),x.instancingColor&&a.enable(2),x.instancingMorph&&a.enable(3),x.matcap&&a.enable(4),x.envMap&&a.enable(5),x.normalMapObjectSpace&&a.enable(6),x.normalMapTangentSpace&&a.enable(7),x.clearcoat&&a.enable(8),x.iridescence&&a.enable(9),x.alphaTest&&a.enable(10),x.vertexColors&&a.enable(11),x.vertexAlphas&&a.enable(12),x.vertexUv1s&&a.enable(13),x.vertexUv2s&&a.enable(14),x.vertexUv3s&&a.enable(15),x.vertexTangents&&a.enable(16),x.anisotropy&&a.enable(17),x.alphaHash&&a.enable(18),x.batching&&a.enable(19),x.dispersion&&a.enable(20),x.batchingColor&&a.enable(21),S.push(a.mask),a.disableAll(),x.fog&&a.enable(0),x.useFog&&a.enable(1),x.flatShading&&a.enable(2),x.logarithmicDepthBuffer&&a.enable(3),x.reverseDepthBuffer&&a.enable(4),x.skinning&&a.enable(5),x.morphTargets&&a.enable(6),x.morphNormals&&a.enable(7),x.morphColors&&a.enable(8),x.premultipliedAlpha&&a.enable(9),x.shadowMapEnabled&&a.enable(10),x.doubleSided&&a.enable(11),x.flipSided&&a.enable(12),x.useDepthPacking&&a.enable(13),x.dithering&&a.enable(14),x.transmission&&a.enable(15),x.sheen&&a.enable(16),x.opaque&&a.enable(17),x.pointsUvs&&a.enable(18),x.decodeVideoTexture&&a.enable(19),x.decodeVideoTextureEmissive&&a.enable(20),x.alphaToCoverage&&a.enable(21),S.push(a.mask)}function v(S){const x=_[S.type];let A;if(x){const V=zi[x];A=Xu.clone(V.uniforms)}else A=S.uniforms;return A}function U(S,x){let A;for(let V=0,N=h.length;V<N;V++){const Y=h[V];if(Y.cacheKey===x){A=Y,++A.usedTimes;break}}return A===void 0&&(A=new wE(i,x,S,r),h.push(A)),A}function P(S){if(--S.usedTimes===0){const x=h.indexOf(S);h[x]=h[h.length-1],h.pop(),S.destroy()}}function L(S){l.remove(S)}function F(){l.dispose()}return{getParameters:m,getProgramCacheKey:d,getUniforms:v,acquireProgram:U,releaseProgram:P,releaseShaderCache:L,programs:h,dispose:F}}function PE(){let i=new WeakMap;function t(o){return i.has(o)}function e(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:t,get:e,remove:n,update:s,dispose:r}}function CE(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.material.id!==t.material.id?i.material.id-t.material.id:i.z!==t.z?i.z-t.z:i.id-t.id}function xp(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.z!==t.z?t.z-i.z:i.id-t.id}function Mp(){const i=[];let t=0;const e=[],n=[],s=[];function r(){t=0,e.length=0,n.length=0,s.length=0}function o(f,u,p,_,b,m){let d=i[t];return d===void 0?(d={id:f.id,object:f,geometry:u,material:p,groupOrder:_,renderOrder:f.renderOrder,z:b,group:m},i[t]=d):(d.id=f.id,d.object=f,d.geometry=u,d.material=p,d.groupOrder=_,d.renderOrder=f.renderOrder,d.z=b,d.group=m),t++,d}function a(f,u,p,_,b,m){const d=o(f,u,p,_,b,m);p.transmission>0?n.push(d):p.transparent===!0?s.push(d):e.push(d)}function l(f,u,p,_,b,m){const d=o(f,u,p,_,b,m);p.transmission>0?n.unshift(d):p.transparent===!0?s.unshift(d):e.unshift(d)}function c(f,u){e.length>1&&e.sort(f||CE),n.length>1&&n.sort(u||xp),s.length>1&&s.sort(u||xp)}function h(){for(let f=t,u=i.length;f<u;f++){const p=i[f];if(p.id===null)break;p.id=null,p.object=null,p.geometry=null,p.material=null,p.group=null}}return{opaque:e,transmissive:n,transparent:s,init:r,push:a,unshift:l,finish:h,sort:c}}function LE(){let i=new WeakMap;function t(n,s){const r=i.get(n);let o;return r===void 0?(o=new Mp,i.set(n,[o])):s>=r.length?(o=new Mp,r.push(o)):o=r[s],o}function e(){i=new WeakMap}return{get:t,dispose:e}}function IE(){const i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"DirectionalLight":e={direction:new D,color:new re};break;case"SpotLight":e={position:new D,direction:new D,color:new re,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new D,color:new re,distance:0,decay:0};break;case"HemisphereLight":e={direction:new D,skyColor:new re,groundColor:new re};break;case"RectAreaLight":e={color:new re,position:new D,halfWidth:new D,halfHeight:new D};break}return i[t.id]=e,e}}}function FE(){const i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $t};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $t};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $t,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[t.id]=e,e}}}let DE=0;function UE(i,t){return(t.castShadow?2:0)-(i.castShadow?2:0)+(t.map?1:0)-(i.map?1:0)}function NE(i){const t=new IE,e=FE(),n={version:0,hash:{directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new D);const s=new D,r=new Pe,o=new Pe;function a(c){let h=0,f=0,u=0;for(let S=0;S<9;S++)n.probe[S].set(0,0,0);let p=0,_=0,b=0,m=0,d=0,M=0,w=0,v=0,U=0,P=0,L=0;c.sort(UE);for(let S=0,x=c.length;S<x;S++){const A=c[S],V=A.color,N=A.intensity,Y=A.distance,X=A.shadow&&A.shadow.map?A.shadow.map.texture:null;if(A.isAmbientLight)h+=V.r*N,f+=V.g*N,u+=V.b*N;else if(A.isLightProbe){for(let J=0;J<9;J++)n.probe[J].addScaledVector(A.sh.coefficients[J],N);L++}else if(A.isDirectionalLight){const J=t.get(A);if(J.color.copy(A.color).multiplyScalar(A.intensity),A.castShadow){const K=A.shadow,et=e.get(A);et.shadowIntensity=K.intensity,et.shadowBias=K.bias,et.shadowNormalBias=K.normalBias,et.shadowRadius=K.radius,et.shadowMapSize=K.mapSize,n.directionalShadow[p]=et,n.directionalShadowMap[p]=X,n.directionalShadowMatrix[p]=A.shadow.matrix,M++}n.directional[p]=J,p++}else if(A.isSpotLight){const J=t.get(A);J.position.setFromMatrixPosition(A.matrixWorld),J.color.copy(V).multiplyScalar(N),J.distance=Y,J.coneCos=Math.cos(A.angle),J.penumbraCos=Math.cos(A.angle*(1-A.penumbra)),J.decay=A.decay,n.spot[b]=J;const K=A.shadow;if(A.map&&(n.spotLightMap[U]=A.map,U++,K.updateMatrices(A),A.castShadow&&P++),n.spotLightMatrix[b]=K.matrix,A.castShadow){const et=e.get(A);et.shadowIntensity=K.intensity,et.shadowBias=K.bias,et.shadowNormalBias=K.normalBias,et.shadowRadius=K.radius,et.shadowMapSize=K.mapSize,n.spotShadow[b]=et,n.spotShadowMap[b]=X,v++}b++}else if(A.isRectAreaLight){const J=t.get(A);J.color.copy(V).multiplyScalar(N),J.halfWidth.set(A.width*.5,0,0),J.halfHeight.set(0,A.height*.5,0),n.rectArea[m]=J,m++}else if(A.isPointLight){const J=t.get(A);if(J.color.copy(A.color).multiplyScalar(A.intensity),J.distance=A.distance,J.decay=A.decay,A.castShadow){const K=A.shadow,et=e.get(A);et.shadowIntensity=K.intensity,et.shadowBias=K.bias,et.shadowNormalBias=K.normalBias,et.shadowRadius=K.radius,et.shadowMapSize=K.mapSize,et.shadowCameraNear=K.camera.near,et.shadowCameraFar=K.camera.far,n.pointShadow[_]=et,n.pointShadowMap[_]=X,n.pointShadowMatrix[_]=A.shadow.matrix,w++}n.point[_]=J,_++}else if(A.isHemisphereLight){const J=t.get(A);J.skyColor.copy(A.color).multiplyScalar(N),J.groundColor.copy(A.groundColor).multiplyScalar(N),n.hemi[d]=J,d++}}m>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=gt.LTC_FLOAT_1,n.rectAreaLTC2=gt.LTC_FLOAT_2):(n.rectAreaLTC1=gt.LTC_HALF_1,n.rectAreaLTC2=gt.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=f,n.ambient[2]=u;const F=n.hash;(F.directionalLength!==p||F.pointLength!==_||F.spotLength!==b||F.rectAreaLength!==m||F.hemiLength!==d||F.numDirectionalShadows!==M||F.numPointShadows!==w||F.numSpotShadows!==v||F.numSpotMaps!==U||F.numLightProbes!==L)&&(n.directional.length=p,n.spot.length=b,n.rectArea.length=m,n.point.length=_,n.hemi.length=d,n.directionalShadow.length=M,n.directionalShadowMap.length=M,n.pointShadow.length=w,n.pointShadowMap.length=w,n.spotShadow.length=v,n.spotShadowMap.length=v,n.directionalShadowMatrix.length=M,n.pointShadowMatrix.length=w,n.spotLightMatrix.length=v+U-P,n.spotLightMap.length=U,n.numSpotLightShadowsWithMaps=P,n.numLightProbes=L,F.directionalLength=p,F.pointLength=_,F.spotLength=b,F.rectAreaLength=m,F.hemiLength=d,F.numDirectionalShadows=M,F.numPointShadows=w,F.numSpotShadows=v,F.numSpotMaps=U,F.numLightProbes=L,n.version=DE++)}function l(c,h){let f=0,u=0,p=0,_=0,b=0;const m=h.matrixWorldInverse;for(let d=0,M=c.length;d<M;d++){const w=c[d];if(w.isDirectionalLight){const v=n.directional[f];v.direction.setFromMatrixPosition(w.matrixWorld),s.setFromMatrixPosition(w.target.matrixWorld),v.direction.sub(s),v.direction.transformDirection(m),f++}else if(w.isSpotLight){const v=n.spot[p];v.position.setFromMatrixPosition(w.matrixWorld),v.position.applyMatrix4(m),v.direction.setFromMatrixPosition(w.matrixWorld),s.setFromMatrixPosition(w.target.matrixWorld),v.direction.sub(s),v.direction.transformDirection(m),p++}else if(w.isRectAreaLight){const v=n.rectArea[_];v.position.setFromMatrixPosition(w.matrixWorld),v.position.applyMatrix4(m),o.identity(),r.copy(w.matrixWorld),r.premultiply(m),o.extractRotation(r),v.halfWidth.set(w.width*.5,0,0),v.halfHeight.set(0,w.height*.5,0),v.halfWidth.applyMatrix4(o),v.halfHeight.applyMatrix4(o),_++}else if(w.isPointLight){const v=n.point[u];v.position.setFromMatrixPosition(w.matrixWorld),v.position.applyMatrix4(m),u++}else if(w.isHemisphereLight){const v=n.hemi[b];v.direction.setFromMatrixPosition(w.matrixWorld),v.direction.transformDirection(m),b++}}}return{setup:a,setupView:l,state:n}}function yp(i){const t=new NE(i),e=[],n=[];function s(h){c.camera=h,e.length=0,n.length=0}function r(h){e.push(h)}function o(h){n.push(h)}function a(){t.setup(e)}function l(h){t.setupView(e,h)}const c={lightsArray:e,shadowsArray:n,camera:null,lights:t,transmissionRenderTarget:{}};return{init:s,state:c,setupLights:a,setupLightsView:l,pushLight:r,pushShadow:o}}function OE(i){let t=new WeakMap;function e(s,r=0){const o=t.get(s);let a;return o===void 0?(a=new yp(i),t.set(s,[a])):r>=o.length?(a=new yp(i),o.push(a)):a=o[r],a}function n(){t=new WeakMap}return{get:e,dispose:n}}class kE extends To{static get type(){return"MeshDepthMaterial"}constructor(t){super(),this.isMeshDepthMaterial=!0,this.depthPacking=Px,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}}class BE extends To{static get type(){return"MeshDistanceMaterial"}constructor(t){super(),this.isMeshDistanceMaterial=!0,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}}const zE=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,VE=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
#include <packing>
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = unpackRGBATo2Half( texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ) );
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = unpackRGBAToDepth( texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ) );
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( squared_mean - mean * mean );
	gl_FragColor = pack2HalfToRGBA( vec2( mean, std_dev ) );
}`;function HE(i,t,e){let n=new qu;const s=new $t,r=new $t,o=new He,a=new kE({depthPacking:Cx}),l=new BE,c={},h=e.maxTextureSize,f={[Vi]:Cn,[Cn]:Vi,[ui]:ui},u=new Hi({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new $t},radius:{value:4}},vertexShader:zE,fragmentShader:VE}),p=u.clone();p.defines.HORIZONTAL_PASS=1;const _=new en;_.setAttribute("position",new Fe(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));const b=new Ye(_,u),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=o_;let d=this.type;this.render=function(P,L,F){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||P.length===0)return;const S=i.getRenderTarget(),x=i.getActiveCubeFace(),A=i.getActiveMipmapLevel(),V=i.state;V.setBlending(ps),V.buffers.color.setClear(1,1,1,1),V.buffers.depth.setTest(!0),V.setScissorTest(!1);const N=d!==Ji&&this.type===Ji,Y=d===Ji&&this.type!==Ji;for(let X=0,J=P.length;X<J;X++){const K=P[X],et=K.shadow;if(et===void 0){console.warn("THREE.WebGLShadowMap:",K,"has no shadow.");continue}if(et.autoUpdate===!1&&et.needsUpdate===!1)continue;s.copy(et.mapSize);const ct=et.getFrameExtents();if(s.multiply(ct),r.copy(et.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/ct.x),s.x=r.x*ct.x,et.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/ct.y),s.y=r.y*ct.y,et.mapSize.y=r.y)),et.map===null||N===!0||Y===!0){const _t=this.type!==Ji?{minFilter:Ln,magFilter:Ln}:{};et.map!==null&&et.map.dispose(),et.map=new Ds(s.x,s.y,_t),et.map.texture.name=K.name+".shadowMap",et.camera.updateProjectionMatrix()}i.setRenderTarget(et.map),i.clear();const ht=et.getViewportCount();for(let _t=0;_t<ht;_t++){const vt=et.getViewport(_t);o.set(r.x*vt.x,r.y*vt.y,r.x*vt.z,r.y*vt.w),V.viewport(o),et.updateMatrices(K,_t),n=et.getFrustum(),v(L,F,et.camera,K,this.type)}et.isPointLightShadow!==!0&&this.type===Ji&&M(et,F),et.needsUpdate=!1}d=this.type,m.needsUpdate=!1,i.setRenderTarget(S,x,A)};function M(P,L){const F=t.update(b);u.defines.VSM_SAMPLES!==P.blurSamples&&(u.defines.VSM_SAMPLES=P.blurSamples,p.defines.VSM_SAMPLES=P.blurSamples,u.needsUpdate=!0,p.needsUpdate=!0),P.mapPass===null&&(P.mapPass=new Ds(s.x,s.y)),u.uniforms.shadow_pass.value=P.map.texture,u.uniforms.resolution.value=P.mapSize,u.uniforms.radius.value=P.radius,i.setRenderTarget(P.mapPass),i.clear(),i.renderBufferDirect(L,null,F,u,b,null),p.uniforms.shadow_pass.value=P.mapPass.texture,p.uniforms.resolution.value=P.mapSize,p.uniforms.radius.value=P.radius,i.setRenderTarget(P.map),i.clear(),i.renderBufferDirect(L,null,F,p,b,null)}function w(P,L,F,S){let x=null;const A=F.isPointLight===!0?P.customDistanceMaterial:P.customDepthMaterial;if(A!==void 0)x=A;else if(x=F.isPointLight===!0?l:a,i.localClippingEnabled&&L.clipShadows===!0&&Array.isArray(L.clippingPlanes)&&L.clippingPlanes.length!==0||L.displacementMap&&L.displacementScale!==0||L.alphaMap&&L.alphaTest>0||L.map&&L.alphaTest>0){const V=x.uuid,N=L.uuid;let Y=c[V];Y===void 0&&(Y={},c[V]=Y);let X=Y[N];X===void 0&&(X=x.clone(),Y[N]=X,L.addEventListener("dispose",U)),x=X}if(x.visible=L.visible,x.wireframe=L.wireframe,S===Ji?x.side=L.shadowSide!==null?L.shadowSide:L.side:x.side=L.shadowSide!==null?L.shadowSide:f[L.side],x.alphaMap=L.alphaMap,x.alphaTest=L.alphaTest,x.map=L.map,x.clipShadows=L.clipShadows,x.clippingPlanes=L.clippingPlanes,x.clipIntersection=L.clipIntersection,x.displacementMap=L.displacementMap,x.displacementScale=L.displacementScale,x.displacementBias=L.displacementBias,x.wireframeLinewidth=L.wireframeLinewidth,x.linewidth=L.linewidth,F.isPointLight===!0&&x.isMeshDistanceMaterial===!0){const V=i.properties.get(x);V.light=F}return x}function v(P,L,F,S,x){if(P.visible===!1)return;if(P.layers.test(L.layers)&&(P.isMesh||P.isLine||P.isPoints)&&(P.castShadow||P.receiveShadow&&x===Ji)&&(!P.frustumCulled||n.intersectsObject(P))){P.modelViewMatrix.multiplyMatrices(F.matrixWorldInverse,P.matrixWorld);const N=t.update(P),Y=P.material;if(Array.isArray(Y)){const X=N.groups;for(let J=0,K=X.length;J<K;J++){const et=X[J],ct=Y[et.materialIndex];if(ct&&ct.visible){const ht=w(P,ct,S,x);P.onBeforeShadow(i,P,L,F,N,ht,et),i.renderBufferDirect(F,null,N,ht,P,et),P.onAfterShadow(i,P,L,F,N,ht,et)}}}else if(Y.visible){const X=w(P,Y,S,x);P.onBeforeShadow(i,P,L,F,N,X,null),i.renderBufferDirect(F,null,N,X,P,null),P.onAfterShadow(i,P,L,F,N,X,null)}}const V=P.children;for(let N=0,Y=V.length;N<Y;N++)v(V[N],L,F,S,x)}function U(P){P.target.removeEventListener("dispose",U);for(const F in c){const S=c[F],x=P.target.uuid;x in S&&(S[x].dispose(),delete S[x])}}}const GE={[Ph]:Ch,[Lh]:Dh,[Ih]:Uh,[mo]:Fh,[Ch]:Ph,[Dh]:Lh,[Uh]:Ih,[Fh]:mo};function WE(i,t){function e(){let z=!1;const yt=new He;let it=null;const ot=new He(0,0,0,0);return{setMask:function(At){it!==At&&!z&&(i.colorMask(At,At,At,At),it=At)},setLocked:function(At){z=At},setClear:function(At,Rt,Jt,Be,dn){dn===!0&&(At*=Be,Rt*=Be,Jt*=Be),yt.set(At,Rt,Jt,Be),ot.equals(yt)===!1&&(i.clearColor(At,Rt,Jt,Be),ot.copy(yt))},reset:function(){z=!1,it=null,ot.set(-1,0,0,0)}}}function n(){let z=!1,yt=!1,it=null,ot=null,At=null;return{setReversed:function(Rt){if(yt!==Rt){const Jt=t.get("EXT_clip_control");yt?Jt.clipControlEXT(Jt.LOWER_LEFT_EXT,Jt.ZERO_TO_ONE_EXT):Jt.clipControlEXT(Jt.LOWER_LEFT_EXT,Jt.NEGATIVE_ONE_TO_ONE_EXT);const Be=At;At=null,this.setClear(Be)}yt=Rt},getReversed:function(){return yt},setTest:function(Rt){Rt?at(i.DEPTH_TEST):zt(i.DEPTH_TEST)},setMask:function(Rt){it!==Rt&&!z&&(i.depthMask(Rt),it=Rt)},setFunc:function(Rt){if(yt&&(Rt=GE[Rt]),ot!==Rt){switch(Rt){case Ph:i.depthFunc(i.NEVER);break;case Ch:i.depthFunc(i.ALWAYS);break;case Lh:i.depthFunc(i.LESS);break;case mo:i.depthFunc(i.LEQUAL);break;case Ih:i.depthFunc(i.EQUAL);break;case Fh:i.depthFunc(i.GEQUAL);break;case Dh:i.depthFunc(i.GREATER);break;case Uh:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}ot=Rt}},setLocked:function(Rt){z=Rt},setClear:function(Rt){At!==Rt&&(yt&&(Rt=1-Rt),i.clearDepth(Rt),At=Rt)},reset:function(){z=!1,it=null,ot=null,At=null,yt=!1}}}function s(){let z=!1,yt=null,it=null,ot=null,At=null,Rt=null,Jt=null,Be=null,dn=null;return{setTest:function(be){z||(be?at(i.STENCIL_TEST):zt(i.STENCIL_TEST))},setMask:function(be){yt!==be&&!z&&(i.stencilMask(be),yt=be)},setFunc:function(be,sn,De){(it!==be||ot!==sn||At!==De)&&(i.stencilFunc(be,sn,De),it=be,ot=sn,At=De)},setOp:function(be,sn,De){(Rt!==be||Jt!==sn||Be!==De)&&(i.stencilOp(be,sn,De),Rt=be,Jt=sn,Be=De)},setLocked:function(be){z=be},setClear:function(be){dn!==be&&(i.clearStencil(be),dn=be)},reset:function(){z=!1,yt=null,it=null,ot=null,At=null,Rt=null,Jt=null,Be=null,dn=null}}}const r=new e,o=new n,a=new s,l=new WeakMap,c=new WeakMap;let h={},f={},u=new WeakMap,p=[],_=null,b=!1,m=null,d=null,M=null,w=null,v=null,U=null,P=null,L=new re(0,0,0),F=0,S=!1,x=null,A=null,V=null,N=null,Y=null;const X=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS);let J=!1,K=0;const et=i.getParameter(i.VERSION);et.indexOf("WebGL")!==-1?(K=parseFloat(/^WebGL (\d)/.exec(et)[1]),J=K>=1):et.indexOf("OpenGL ES")!==-1&&(K=parseFloat(/^OpenGL ES (\d)/.exec(et)[1]),J=K>=2);let ct=null,ht={};const _t=i.getParameter(i.SCISSOR_BOX),vt=i.getParameter(i.VIEWPORT),pt=new He().fromArray(_t),st=new He().fromArray(vt);function lt(z,yt,it,ot){const At=new Uint8Array(4),Rt=i.createTexture();i.bindTexture(z,Rt),i.texParameteri(z,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(z,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Jt=0;Jt<it;Jt++)z===i.TEXTURE_3D||z===i.TEXTURE_2D_ARRAY?i.texImage3D(yt,0,i.RGBA,1,1,ot,0,i.RGBA,i.UNSIGNED_BYTE,At):i.texImage2D(yt+Jt,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,At);return Rt}const bt={};bt[i.TEXTURE_2D]=lt(i.TEXTURE_2D,i.TEXTURE_2D,1),bt[i.TEXTURE_CUBE_MAP]=lt(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),bt[i.TEXTURE_2D_ARRAY]=lt(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),bt[i.TEXTURE_3D]=lt(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),at(i.DEPTH_TEST),o.setFunc(mo),Qt(!1),ee(Td),at(i.CULL_FACE),H(ps);function at(z){h[z]!==!0&&(i.enable(z),h[z]=!0)}function zt(z){h[z]!==!1&&(i.disable(z),h[z]=!1)}function Ht(z,yt){return f[z]!==yt?(i.bindFramebuffer(z,yt),f[z]=yt,z===i.DRAW_FRAMEBUFFER&&(f[i.FRAMEBUFFER]=yt),z===i.FRAMEBUFFER&&(f[i.DRAW_FRAMEBUFFER]=yt),!0):!1}function Ut(z,yt){let it=p,ot=!1;if(z){it=u.get(yt),it===void 0&&(it=[],u.set(yt,it));const At=z.textures;if(it.length!==At.length||it[0]!==i.COLOR_ATTACHMENT0){for(let Rt=0,Jt=At.length;Rt<Jt;Rt++)it[Rt]=i.COLOR_ATTACHMENT0+Rt;it.length=At.length,ot=!0}}else it[0]!==i.BACK&&(it[0]=i.BACK,ot=!0);ot&&i.drawBuffers(it)}function ce(z){return _!==z?(i.useProgram(z),_=z,!0):!1}const Kt={[or]:i.FUNC_ADD,[nx]:i.FUNC_SUBTRACT,[ix]:i.FUNC_REVERSE_SUBTRACT};Kt[sx]=i.MIN,Kt[rx]=i.MAX;const he={[ox]:i.ZERO,[ax]:i.ONE,[lx]:i.SRC_COLOR,[Ah]:i.SRC_ALPHA,[px]:i.SRC_ALPHA_SATURATE,[fx]:i.DST_COLOR,[hx]:i.DST_ALPHA,[cx]:i.ONE_MINUS_SRC_COLOR,[Rh]:i.ONE_MINUS_SRC_ALPHA,[dx]:i.ONE_MINUS_DST_COLOR,[ux]:i.ONE_MINUS_DST_ALPHA,[mx]:i.CONSTANT_COLOR,[_x]:i.ONE_MINUS_CONSTANT_COLOR,[gx]:i.CONSTANT_ALPHA,[bx]:i.ONE_MINUS_CONSTANT_ALPHA};function H(z,yt,it,ot,At,Rt,Jt,Be,dn,be){if(z===ps){b===!0&&(zt(i.BLEND),b=!1);return}if(b===!1&&(at(i.BLEND),b=!0),z!==ex){if(z!==m||be!==S){if((d!==or||v!==or)&&(i.blendEquation(i.FUNC_ADD),d=or,v=or),be)switch(z){case ro:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Ad:i.blendFunc(i.ONE,i.ONE);break;case Rd:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Pd:i.blendFuncSeparate(i.ZERO,i.SRC_COLOR,i.ZERO,i.SRC_ALPHA);break;default:console.error("THREE.WebGLState: Invalid blending: ",z);break}else switch(z){case ro:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case Ad:i.blendFunc(i.SRC_ALPHA,i.ONE);break;case Rd:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case Pd:i.blendFunc(i.ZERO,i.SRC_COLOR);break;default:console.error("THREE.WebGLState: Invalid blending: ",z);break}M=null,w=null,U=null,P=null,L.set(0,0,0),F=0,m=z,S=be}return}At=At||yt,Rt=Rt||it,Jt=Jt||ot,(yt!==d||At!==v)&&(i.blendEquationSeparate(Kt[yt],Kt[At]),d=yt,v=At),(it!==M||ot!==w||Rt!==U||Jt!==P)&&(i.blendFuncSeparate(he[it],he[ot],he[Rt],he[Jt]),M=it,w=ot,U=Rt,P=Jt),(Be.equals(L)===!1||dn!==F)&&(i.blendColor(Be.r,Be.g,Be.b,dn),L.copy(Be),F=dn),m=z,S=!1}function nn(z,yt){z.side===ui?zt(i.CULL_FACE):at(i.CULL_FACE);let it=z.side===Cn;yt&&(it=!it),Qt(it),z.blending===ro&&z.transparent===!1?H(ps):H(z.blending,z.blendEquation,z.blendSrc,z.blendDst,z.blendEquationAlpha,z.blendSrcAlpha,z.blendDstAlpha,z.blendColor,z.blendAlpha,z.premultipliedAlpha),o.setFunc(z.depthFunc),o.setTest(z.depthTest),o.setMask(z.depthWrite),r.setMask(z.colorWrite);const ot=z.stencilWrite;a.setTest(ot),ot&&(a.setMask(z.stencilWriteMask),a.setFunc(z.stencilFunc,z.stencilRef,z.stencilFuncMask),a.setOp(z.stencilFail,z.stencilZFail,z.stencilZPass)),de(z.polygonOffset,z.polygonOffsetFactor,z.polygonOffsetUnits),z.alphaToCoverage===!0?at(i.SAMPLE_ALPHA_TO_COVERAGE):zt(i.SAMPLE_ALPHA_TO_COVERAGE)}function Qt(z){x!==z&&(z?i.frontFace(i.CW):i.frontFace(i.CCW),x=z)}function ee(z){z!==Jv?(at(i.CULL_FACE),z!==A&&(z===Td?i.cullFace(i.BACK):z===Qv?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):zt(i.CULL_FACE),A=z}function Gt(z){z!==V&&(J&&i.lineWidth(z),V=z)}function de(z,yt,it){z?(at(i.POLYGON_OFFSET_FILL),(N!==yt||Y!==it)&&(i.polygonOffset(yt,it),N=yt,Y=it)):zt(i.POLYGON_OFFSET_FILL)}function Lt(z){z?at(i.SCISSOR_TEST):zt(i.SCISSOR_TEST)}function C(z){z===void 0&&(z=i.TEXTURE0+X-1),ct!==z&&(i.activeTexture(z),ct=z)}function E(z,yt,it){it===void 0&&(ct===null?it=i.TEXTURE0+X-1:it=ct);let ot=ht[it];ot===void 0&&(ot={type:void 0,texture:void 0},ht[it]=ot),(ot.type!==z||ot.texture!==yt)&&(ct!==it&&(i.activeTexture(it),ct=it),i.bindTexture(z,yt||bt[z]),ot.type=z,ot.texture=yt)}function Z(){const z=ht[ct];z!==void 0&&z.type!==void 0&&(i.bindTexture(z.type,null),z.type=void 0,z.texture=void 0)}function Q(){try{i.compressedTexImage2D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function W(){try{i.compressedTexImage3D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function nt(){try{i.texSubImage2D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function St(){try{i.texSubImage3D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function xt(){try{i.compressedTexSubImage2D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function Tt(){try{i.compressedTexSubImage3D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function Zt(){try{i.texStorage2D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function dt(){try{i.texStorage3D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function Mt(){try{i.texImage2D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function Nt(){try{i.texImage3D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function kt(z){pt.equals(z)===!1&&(i.scissor(z.x,z.y,z.z,z.w),pt.copy(z))}function Et(z){st.equals(z)===!1&&(i.viewport(z.x,z.y,z.z,z.w),st.copy(z))}function ie(z,yt){let it=c.get(yt);it===void 0&&(it=new WeakMap,c.set(yt,it));let ot=it.get(z);ot===void 0&&(ot=i.getUniformBlockIndex(yt,z.name),it.set(z,ot))}function qt(z,yt){const ot=c.get(yt).get(z);l.get(yt)!==ot&&(i.uniformBlockBinding(yt,ot,z.__bindingPointIndex),l.set(yt,ot))}function pe(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),o.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),h={},ct=null,ht={},f={},u=new WeakMap,p=[],_=null,b=!1,m=null,d=null,M=null,w=null,v=null,U=null,P=null,L=new re(0,0,0),F=0,S=!1,x=null,A=null,V=null,N=null,Y=null,pt.set(0,0,i.canvas.width,i.canvas.height),st.set(0,0,i.canvas.width,i.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:at,disable:zt,bindFramebuffer:Ht,drawBuffers:Ut,useProgram:ce,setBlending:H,setMaterial:nn,setFlipSided:Qt,setCullFace:ee,setLineWidth:Gt,setPolygonOffset:de,setScissorTest:Lt,activeTexture:C,bindTexture:E,unbindTexture:Z,compressedTexImage2D:Q,compressedTexImage3D:W,texImage2D:Mt,texImage3D:Nt,updateUBOMapping:ie,uniformBlockBinding:qt,texStorage2D:Zt,texStorage3D:dt,texSubImage2D:nt,texSubImage3D:St,compressedTexSubImage2D:xt,compressedTexSubImage3D:Tt,scissor:kt,viewport:Et,reset:pe}}function Sp(i,t,e,n){const s=XE(n);switch(e){case h_:return i*t;case f_:return i*t;case d_:return i*t*2;case Hu:return i*t/s.components*s.byteLength;case Gu:return i*t/s.components*s.byteLength;case p_:return i*t*2/s.components*s.byteLength;case Wu:return i*t*2/s.components*s.byteLength;case u_:return i*t*3/s.components*s.byteLength;case Ai:return i*t*4/s.components*s.byteLength;case Xl:return i*t*4/s.components*s.byteLength;case nl:case il:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case sl:case rl:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Vh:case Gh:return Math.max(i,16)*Math.max(t,8)/4;case zh:case Hh:return Math.max(i,8)*Math.max(t,8)/2;case Wh:case Xh:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case Yh:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case qh:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case jh:return Math.floor((i+4)/5)*Math.floor((t+3)/4)*16;case $h:return Math.floor((i+4)/5)*Math.floor((t+4)/5)*16;case Zh:return Math.floor((i+5)/6)*Math.floor((t+4)/5)*16;case Kh:return Math.floor((i+5)/6)*Math.floor((t+5)/6)*16;case Jh:return Math.floor((i+7)/8)*Math.floor((t+4)/5)*16;case Qh:return Math.floor((i+7)/8)*Math.floor((t+5)/6)*16;case tu:return Math.floor((i+7)/8)*Math.floor((t+7)/8)*16;case eu:return Math.floor((i+9)/10)*Math.floor((t+4)/5)*16;case nu:return Math.floor((i+9)/10)*Math.floor((t+5)/6)*16;case iu:return Math.floor((i+9)/10)*Math.floor((t+7)/8)*16;case su:return Math.floor((i+9)/10)*Math.floor((t+9)/10)*16;case ru:return Math.floor((i+11)/12)*Math.floor((t+9)/10)*16;case ou:return Math.floor((i+11)/12)*Math.floor((t+11)/12)*16;case ol:case au:case lu:return Math.ceil(i/4)*Math.ceil(t/4)*16;case m_:case cu:return Math.ceil(i/4)*Math.ceil(t/4)*8;case hu:case uu:return Math.ceil(i/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function XE(i){switch(i){case _s:case l_:return{byteLength:1,components:1};case sa:case Bu:case oa:return{byteLength:2,components:1};case zu:case Vu:return{byteLength:2,components:4};case mr:case Wl:case Ti:return{byteLength:4,components:1};case c_:return{byteLength:4,components:3}}throw new Error(`Unknown texture type ${i}.`)}function YE(i,t,e,n,s,r,o){const a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new $t,h=new WeakMap;let f;const u=new WeakMap;let p=!1;try{p=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function _(C,E){return p?new OffscreenCanvas(C,E):Pl("canvas")}function b(C,E,Z){let Q=1;const W=Lt(C);if((W.width>Z||W.height>Z)&&(Q=Z/Math.max(W.width,W.height)),Q<1)if(typeof HTMLImageElement<"u"&&C instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&C instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&C instanceof ImageBitmap||typeof VideoFrame<"u"&&C instanceof VideoFrame){const nt=Math.floor(Q*W.width),St=Math.floor(Q*W.height);f===void 0&&(f=_(nt,St));const xt=E?_(nt,St):f;return xt.width=nt,xt.height=St,xt.getContext("2d").drawImage(C,0,0,nt,St),console.warn("THREE.WebGLRenderer: Texture has been resized from ("+W.width+"x"+W.height+") to ("+nt+"x"+St+")."),xt}else return"data"in C&&console.warn("THREE.WebGLRenderer: Image in DataTexture is too big ("+W.width+"x"+W.height+")."),C;return C}function m(C){return C.generateMipmaps}function d(C){i.generateMipmap(C)}function M(C){return C.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:C.isWebGL3DRenderTarget?i.TEXTURE_3D:C.isWebGLArrayRenderTarget||C.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function w(C,E,Z,Q,W=!1){if(C!==null){if(i[C]!==void 0)return i[C];console.warn("THREE.WebGLRenderer: Attempt to use non-existing WebGL internal format '"+C+"'")}let nt=E;if(E===i.RED&&(Z===i.FLOAT&&(nt=i.R32F),Z===i.HALF_FLOAT&&(nt=i.R16F),Z===i.UNSIGNED_BYTE&&(nt=i.R8)),E===i.RED_INTEGER&&(Z===i.UNSIGNED_BYTE&&(nt=i.R8UI),Z===i.UNSIGNED_SHORT&&(nt=i.R16UI),Z===i.UNSIGNED_INT&&(nt=i.R32UI),Z===i.BYTE&&(nt=i.R8I),Z===i.SHORT&&(nt=i.R16I),Z===i.INT&&(nt=i.R32I)),E===i.RG&&(Z===i.FLOAT&&(nt=i.RG32F),Z===i.HALF_FLOAT&&(nt=i.RG16F),Z===i.UNSIGNED_BYTE&&(nt=i.RG8)),E===i.RG_INTEGER&&(Z===i.UNSIGNED_BYTE&&(nt=i.RG8UI),Z===i.UNSIGNED_SHORT&&(nt=i.RG16UI),Z===i.UNSIGNED_INT&&(nt=i.RG32UI),Z===i.BYTE&&(nt=i.RG8I),Z===i.SHORT&&(nt=i.RG16I),Z===i.INT&&(nt=i.RG32I)),E===i.RGB_INTEGER&&(Z===i.UNSIGNED_BYTE&&(nt=i.RGB8UI),Z===i.UNSIGNED_SHORT&&(nt=i.RGB16UI),Z===i.UNSIGNED_INT&&(nt=i.RGB32UI),Z===i.BYTE&&(nt=i.RGB8I),Z===i.SHORT&&(nt=i.RGB16I),Z===i.INT&&(nt=i.RGB32I)),E===i.RGBA_INTEGER&&(Z===i.UNSIGNED_BYTE&&(nt=i.RGBA8UI),Z===i.UNSIGNED_SHORT&&(nt=i.RGBA16UI),Z===i.UNSIGNED_INT&&(nt=i.RGBA32UI),Z===i.BYTE&&(nt=i.RGBA8I),Z===i.SHORT&&(nt=i.RGBA16I),Z===i.INT&&(nt=i.RGBA32I)),E===i.RGB&&Z===i.UNSIGNED_INT_5_9_9_9_REV&&(nt=i.RGB9_E5),E===i.RGBA){const St=W?Yl:fe.getTransfer(Q);Z===i.FLOAT&&(nt=i.RGBA32F),Z===i.HALF_FLOAT&&(nt=i.RGBA16F),Z===i.UNSIGNED_BYTE&&(nt=St===Ae?i.SRGB8_ALPHA8:i.RGBA8),Z===i.UNSIGNED_SHORT_4_4_4_4&&(nt=i.RGBA4),Z===i.UNSIGNED_SHORT_5_5_5_1&&(nt=i.RGB5_A1)}return(nt===i.R16F||nt===i.R32F||nt===i.RG16F||nt===i.RG32F||nt===i.RGBA16F||nt===i.RGBA32F)&&t.get("EXT_color_buffer_float"),nt}function v(C,E){let Z;return C?E===null||E===mr||E===bo?Z=i.DEPTH24_STENCIL8:E===Ti?Z=i.DEPTH32F_STENCIL8:E===sa&&(Z=i.DEPTH24_STENCIL8,console.warn("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):E===null||E===mr||E===bo?Z=i.DEPTH_COMPONENT24:E===Ti?Z=i.DEPTH_COMPONENT32F:E===sa&&(Z=i.DEPTH_COMPONENT16),Z}function U(C,E){return m(C)===!0||C.isFramebufferTexture&&C.minFilter!==Ln&&C.minFilter!==Ei?Math.log2(Math.max(E.width,E.height))+1:C.mipmaps!==void 0&&C.mipmaps.length>0?C.mipmaps.length:C.isCompressedTexture&&Array.isArray(C.image)?E.mipmaps.length:1}function P(C){const E=C.target;E.removeEventListener("dispose",P),F(E),E.isVideoTexture&&h.delete(E)}function L(C){const E=C.target;E.removeEventListener("dispose",L),x(E)}function F(C){const E=n.get(C);if(E.__webglInit===void 0)return;const Z=C.source,Q=u.get(Z);if(Q){const W=Q[E.__cacheKey];W.usedTimes--,W.usedTimes===0&&S(C),Object.keys(Q).length===0&&u.delete(Z)}n.remove(C)}function S(C){const E=n.get(C);i.deleteTexture(E.__webglTexture);const Z=C.source,Q=u.get(Z);delete Q[E.__cacheKey],o.memory.textures--}function x(C){const E=n.get(C);if(C.depthTexture&&(C.depthTexture.dispose(),n.remove(C.depthTexture)),C.isWebGLCubeRenderTarget)for(let Q=0;Q<6;Q++){if(Array.isArray(E.__webglFramebuffer[Q]))for(let W=0;W<E.__webglFramebuffer[Q].length;W++)i.deleteFramebuffer(E.__webglFramebuffer[Q][W]);else i.deleteFramebuffer(E.__webglFramebuffer[Q]);E.__webglDepthbuffer&&i.deleteRenderbuffer(E.__webglDepthbuffer[Q])}else{if(Array.isArray(E.__webglFramebuffer))for(let Q=0;Q<E.__webglFramebuffer.length;Q++)i.deleteFramebuffer(E.__webglFramebuffer[Q]);else i.deleteFramebuffer(E.__webglFramebuffer);if(E.__webglDepthbuffer&&i.deleteRenderbuffer(E.__webglDepthbuffer),E.__webglMultisampledFramebuffer&&i.deleteFramebuffer(E.__webglMultisampledFramebuffer),E.__webglColorRenderbuffer)for(let Q=0;Q<E.__webglColorRenderbuffer.length;Q++)E.__webglColorRenderbuffer[Q]&&i.deleteRenderbuffer(E.__webglColorRenderbuffer[Q]);E.__webglDepthRenderbuffer&&i.deleteRenderbuffer(E.__webglDepthRenderbuffer)}const Z=C.textures;for(let Q=0,W=Z.length;Q<W;Q++){const nt=n.get(Z[Q]);nt.__webglTexture&&(i.deleteTexture(nt.__webglTexture),o.memory.textures--),n.remove(Z[Q])}n.remove(C)}let A=0;function V(){A=0}function N(){const C=A;return C>=s.maxTextures&&console.warn("THREE.WebGLTextures: Trying to use "+C+" texture units while this GPU supports only "+s.maxTextures),A+=1,C}function Y(C){const E=[];return E.push(C.wrapS),E.push(C.wrapT),E.push(C.wrapR||0),E.push(C.magFilter),E.push(C.minFilter),E.push(C.anisotropy),E.push(C.internalFormat),E.push(C.format),E.push(C.type),E.push(C.generateMipmaps),E.push(C.premultiplyAlpha),E.push(C.flipY),E.push(C.unpackAlignment),E.push(C.colorSpace),E.join()}function X(C,E){const Z=n.get(C);if(C.isVideoTexture&&Gt(C),C.isRenderTargetTexture===!1&&C.version>0&&Z.__version!==C.version){const Q=C.image;if(Q===null)console.warn("THREE.WebGLRenderer: Texture marked for update but no image data found.");else if(Q.complete===!1)console.warn("THREE.WebGLRenderer: Texture marked for update but image is incomplete");else{st(Z,C,E);return}}e.bindTexture(i.TEXTURE_2D,Z.__webglTexture,i.TEXTURE0+E)}function J(C,E){const Z=n.get(C);if(C.version>0&&Z.__version!==C.version){st(Z,C,E);return}e.bindTexture(i.TEXTURE_2D_ARRAY,Z.__webglTexture,i.TEXTURE0+E)}function K(C,E){const Z=n.get(C);if(C.version>0&&Z.__version!==C.version){st(Z,C,E);return}e.bindTexture(i.TEXTURE_3D,Z.__webglTexture,i.TEXTURE0+E)}function et(C,E){const Z=n.get(C);if(C.version>0&&Z.__version!==C.version){lt(Z,C,E);return}e.bindTexture(i.TEXTURE_CUBE_MAP,Z.__webglTexture,i.TEXTURE0+E)}const ct={[kh]:i.REPEAT,[lr]:i.CLAMP_TO_EDGE,[Bh]:i.MIRRORED_REPEAT},ht={[Ln]:i.NEAREST,[Rx]:i.NEAREST_MIPMAP_NEAREST,[ya]:i.NEAREST_MIPMAP_LINEAR,[Ei]:i.LINEAR,[yc]:i.LINEAR_MIPMAP_NEAREST,[cr]:i.LINEAR_MIPMAP_LINEAR},_t={[Ox]:i.NEVER,[Gx]:i.ALWAYS,[kx]:i.LESS,[__]:i.LEQUAL,[Bx]:i.EQUAL,[Hx]:i.GEQUAL,[zx]:i.GREATER,[Vx]:i.NOTEQUAL};function vt(C,E){if(E.type===Ti&&t.has("OES_texture_float_linear")===!1&&(E.magFilter===Ei||E.magFilter===yc||E.magFilter===ya||E.magFilter===cr||E.minFilter===Ei||E.minFilter===yc||E.minFilter===ya||E.minFilter===cr)&&console.warn("THREE.WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(C,i.TEXTURE_WRAP_S,ct[E.wrapS]),i.texParameteri(C,i.TEXTURE_WRAP_T,ct[E.wrapT]),(C===i.TEXTURE_3D||C===i.TEXTURE_2D_ARRAY)&&i.texParameteri(C,i.TEXTURE_WRAP_R,ct[E.wrapR]),i.texParameteri(C,i.TEXTURE_MAG_FILTER,ht[E.magFilter]),i.texParameteri(C,i.TEXTURE_MIN_FILTER,ht[E.minFilter]),E.compareFunction&&(i.texParameteri(C,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(C,i.TEXTURE_COMPARE_FUNC,_t[E.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(E.magFilter===Ln||E.minFilter!==ya&&E.minFilter!==cr||E.type===Ti&&t.has("OES_texture_float_linear")===!1)return;if(E.anisotropy>1||n.get(E).__currentAnisotropy){const Z=t.get("EXT_texture_filter_anisotropic");i.texParameterf(C,Z.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(E.anisotropy,s.getMaxAnisotropy())),n.get(E).__currentAnisotropy=E.anisotropy}}}function pt(C,E){let Z=!1;C.__webglInit===void 0&&(C.__webglInit=!0,E.addEventListener("dispose",P));const Q=E.source;let W=u.get(Q);W===void 0&&(W={},u.set(Q,W));const nt=Y(E);if(nt!==C.__cacheKey){W[nt]===void 0&&(W[nt]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,Z=!0),W[nt].usedTimes++;const St=W[C.__cacheKey];St!==void 0&&(W[C.__cacheKey].usedTimes--,St.usedTimes===0&&S(E)),C.__cacheKey=nt,C.__webglTexture=W[nt].texture}return Z}function st(C,E,Z){let Q=i.TEXTURE_2D;(E.isDataArrayTexture||E.isCompressedArrayTexture)&&(Q=i.TEXTURE_2D_ARRAY),E.isData3DTexture&&(Q=i.TEXTURE_3D);const W=pt(C,E),nt=E.source;e.bindTexture(Q,C.__webglTexture,i.TEXTURE0+Z);const St=n.get(nt);if(nt.version!==St.__version||W===!0){e.activeTexture(i.TEXTURE0+Z);const xt=fe.getPrimaries(fe.workingColorSpace),Tt=E.colorSpace===Ls?null:fe.getPrimaries(E.colorSpace),Zt=E.colorSpace===Ls||xt===Tt?i.NONE:i.BROWSER_DEFAULT_WEBGL;i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,E.flipY),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,E.premultiplyAlpha),i.pixelStorei(i.UNPACK_ALIGNMENT,E.unpackAlignment),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Zt);let dt=b(E.image,!1,s.maxTextureSize);dt=de(E,dt);const Mt=r.convert(E.format,E.colorSpace),Nt=r.convert(E.type);let kt=w(E.internalFormat,Mt,Nt,E.colorSpace,E.isVideoTexture);vt(Q,E);let Et;const ie=E.mipmaps,qt=E.isVideoTexture!==!0,pe=St.__version===void 0||W===!0,z=nt.dataReady,yt=U(E,dt);if(E.isDepthTexture)kt=v(E.format===vo,E.type),pe&&(qt?e.texStorage2D(i.TEXTURE_2D,1,kt,dt.width,dt.height):e.texImage2D(i.TEXTURE_2D,0,kt,dt.width,dt.height,0,Mt,Nt,null));else if(E.isDataTexture)if(ie.length>0){qt&&pe&&e.texStorage2D(i.TEXTURE_2D,yt,kt,ie[0].width,ie[0].height);for(let it=0,ot=ie.length;it<ot;it++)Et=ie[it],qt?z&&e.texSubImage2D(i.TEXTURE_2D,it,0,0,Et.width,Et.height,Mt,Nt,Et.data):e.texImage2D(i.TEXTURE_2D,it,kt,Et.width,Et.height,0,Mt,Nt,Et.data);E.generateMipmaps=!1}else qt?(pe&&e.texStorage2D(i.TEXTURE_2D,yt,kt,dt.width,dt.height),z&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,dt.width,dt.height,Mt,Nt,dt.data)):e.texImage2D(i.TEXTURE_2D,0,kt,dt.width,dt.height,0,Mt,Nt,dt.data);else if(E.isCompressedTexture)if(E.isCompressedArrayTexture){qt&&pe&&e.texStorage3D(i.TEXTURE_2D_ARRAY,yt,kt,ie[0].width,ie[0].height,dt.depth);for(let it=0,ot=ie.length;it<ot;it++)if(Et=ie[it],E.format!==Ai)if(Mt!==null)if(qt){if(z)if(E.layerUpdates.size>0){const At=Sp(Et.width,Et.height,E.format,E.type);for(const Rt of E.layerUpdates){const Jt=Et.data.subarray(Rt*At/Et.data.BYTES_PER_ELEMENT,(Rt+1)*At/Et.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,it,0,0,Rt,Et.width,Et.height,1,Mt,Jt)}E.clearLayerUpdates()}else e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,it,0,0,0,Et.width,Et.height,dt.depth,Mt,Et.data)}else e.compressedTexImage3D(i.TEXTURE_2D_ARRAY,it,kt,Et.width,Et.height,dt.depth,0,Et.data,0,0);else console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else qt?z&&e.texSubImage3D(i.TEXTURE_2D_ARRAY,it,0,0,0,Et.width,Et.height,dt.depth,Mt,Nt,Et.data):e.texImage3D(i.TEXTURE_2D_ARRAY,it,kt,Et.width,Et.height,dt.depth,0,Mt,Nt,Et.data)}else{qt&&pe&&e.texStorage2D(i.TEXTURE_2D,yt,kt,ie[0].width,ie[0].height);for(let it=0,ot=ie.length;it<ot;it++)Et=ie[it],E.format!==Ai?Mt!==null?qt?z&&e.compressedTexSubImage2D(i.TEXTURE_2D,it,0,0,Et.width,Et.height,Mt,Et.data):e.compressedTexImage2D(i.TEXTURE_2D,it,kt,Et.width,Et.height,0,Et.data):console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):qt?z&&e.texSubImage2D(i.TEXTURE_2D,it,0,0,Et.width,Et.height,Mt,Nt,Et.data):e.texImage2D(i.TEXTURE_2D,it,kt,Et.width,Et.height,0,Mt,Nt,Et.data)}else if(E.isDataArrayTexture)if(qt){if(pe&&e.texStorage3D(i.TEXTURE_2D_ARRAY,yt,kt,dt.width,dt.height,dt.depth),z)if(E.layerUpdates.size>0){const it=Sp(dt.width,dt.height,E.format,E.type);for(const ot of E.layerUpdates){const At=dt.data.subarray(ot*it/dt.data.BYTES_PER_ELEMENT,(ot+1)*it/dt.data.BYTES_PER_ELEMENT);e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,ot,dt.width,dt.height,1,Mt,Nt,At)}E.clearLayerUpdates()}else e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,dt.width,dt.height,dt.depth,Mt,Nt,dt.data)}else e.texImage3D(i.TEXTURE_2D_ARRAY,0,kt,dt.width,dt.height,dt.depth,0,Mt,Nt,dt.data);else if(E.isData3DTexture)qt?(pe&&e.texStorage3D(i.TEXTURE_3D,yt,kt,dt.width,dt.height,dt.depth),z&&e.texSubImage3D(i.TEXTURE_3D,0,0,0,0,dt.width,dt.height,dt.depth,Mt,Nt,dt.data)):e.texImage3D(i.TEXTURE_3D,0,kt,dt.width,dt.height,dt.depth,0,Mt,Nt,dt.data);else if(E.isFramebufferTexture){if(pe)if(qt)e.texStorage2D(i.TEXTURE_2D,yt,kt,dt.width,dt.height);else{let it=dt.width,ot=dt.height;for(let At=0;At<yt;At++)e.texImage2D(i.TEXTURE_2D,At,kt,it,ot,0,Mt,Nt,null),it>>=1,ot>>=1}}else if(ie.length>0){if(qt&&pe){const it=Lt(ie[0]);e.texStorage2D(i.TEXTURE_2D,yt,kt,it.width,it.height)}for(let it=0,ot=ie.length;it<ot;it++)Et=ie[it],qt?z&&e.texSubImage2D(i.TEXTURE_2D,it,0,0,Mt,Nt,Et):e.texImage2D(i.TEXTURE_2D,it,kt,Mt,Nt,Et);E.generateMipmaps=!1}else if(qt){if(pe){const it=Lt(dt);e.texStorage2D(i.TEXTURE_2D,yt,kt,it.width,it.height)}z&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,Mt,Nt,dt)}else e.texImage2D(i.TEXTURE_2D,0,kt,Mt,Nt,dt);m(E)&&d(Q),St.__version=nt.version,E.onUpdate&&E.onUpdate(E)}C.__version=E.version}function lt(C,E,Z){if(E.image.length!==6)return;const Q=pt(C,E),W=E.source;e.bindTexture(i.TEXTURE_CUBE_MAP,C.__webglTexture,i.TEXTURE0+Z);const nt=n.get(W);if(W.version!==nt.__version||Q===!0){e.activeTexture(i.TEXTURE0+Z);const St=fe.getPrimaries(fe.workingColorSpace),xt=E.colorSpace===Ls?null:fe.getPrimaries(E.colorSpace),Tt=E.colorSpace===Ls||St===xt?i.NONE:i.BROWSER_DEFAULT_WEBGL;i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,E.flipY),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,E.premultiplyAlpha),i.pixelStorei(i.UNPACK_ALIGNMENT,E.unpackAlignment),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Tt);const Zt=E.isCompressedTexture||E.image[0].isCompressedTexture,dt=E.image[0]&&E.image[0].isDataTexture,Mt=[];for(let ot=0;ot<6;ot++)!Zt&&!dt?Mt[ot]=b(E.image[ot],!0,s.maxCubemapSize):Mt[ot]=dt?E.image[ot].image:E.image[ot],Mt[ot]=de(E,Mt[ot]);const Nt=Mt[0],kt=r.convert(E.format,E.colorSpace),Et=r.convert(E.type),ie=w(E.internalFormat,kt,Et,E.colorSpace),qt=E.isVideoTexture!==!0,pe=nt.__version===void 0||Q===!0,z=W.dataReady;let yt=U(E,Nt);vt(i.TEXTURE_CUBE_MAP,E);let it;if(Zt){qt&&pe&&e.texStorage2D(i.TEXTURE_CUBE_MAP,yt,ie,Nt.width,Nt.height);for(let ot=0;ot<6;ot++){it=Mt[ot].mipmaps;for(let At=0;At<it.length;At++){const Rt=it[At];E.format!==Ai?kt!==null?qt?z&&e.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At,0,0,Rt.width,Rt.height,kt,Rt.data):e.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At,ie,Rt.width,Rt.height,0,Rt.data):console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):qt?z&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At,0,0,Rt.width,Rt.height,kt,Et,Rt.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At,ie,Rt.width,Rt.height,0,kt,Et,Rt.data)}}}else{if(it=E.mipmaps,qt&&pe){it.length>0&&yt++;const ot=Lt(Mt[0]);e.texStorage2D(i.TEXTURE_CUBE_MAP,yt,ie,ot.width,ot.height)}for(let ot=0;ot<6;ot++)if(dt){qt?z&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,0,0,0,Mt[ot].width,Mt[ot].height,kt,Et,Mt[ot].data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,0,ie,Mt[ot].width,Mt[ot].height,0,kt,Et,Mt[ot].data);for(let At=0;At<it.length;At++){const Jt=it[At].image[ot].image;qt?z&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At+1,0,0,Jt.width,Jt.height,kt,Et,Jt.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At+1,ie,Jt.width,Jt.height,0,kt,Et,Jt.data)}}else{qt?z&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,0,0,0,kt,Et,Mt[ot]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,0,ie,kt,Et,Mt[ot]);for(let At=0;At<it.length;At++){const Rt=it[At];qt?z&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At+1,0,0,kt,Et,Rt.image[ot]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At+1,ie,kt,Et,Rt.image[ot])}}}m(E)&&d(i.TEXTURE_CUBE_MAP),nt.__version=W.version,E.onUpdate&&E.onUpdate(E)}C.__version=E.version}function bt(C,E,Z,Q,W,nt){const St=r.convert(Z.format,Z.colorSpace),xt=r.convert(Z.type),Tt=w(Z.internalFormat,St,xt,Z.colorSpace),Zt=n.get(E),dt=n.get(Z);if(dt.__renderTarget=E,!Zt.__hasExternalTextures){const Mt=Math.max(1,E.width>>nt),Nt=Math.max(1,E.height>>nt);W===i.TEXTURE_3D||W===i.TEXTURE_2D_ARRAY?e.texImage3D(W,nt,Tt,Mt,Nt,E.depth,0,St,xt,null):e.texImage2D(W,nt,Tt,Mt,Nt,0,St,xt,null)}e.bindFramebuffer(i.FRAMEBUFFER,C),ee(E)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,Q,W,dt.__webglTexture,0,Qt(E)):(W===i.TEXTURE_2D||W>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&W<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,Q,W,dt.__webglTexture,nt),e.bindFramebuffer(i.FRAMEBUFFER,null)}function at(C,E,Z){if(i.bindRenderbuffer(i.RENDERBUFFER,C),E.depthBuffer){const Q=E.depthTexture,W=Q&&Q.isDepthTexture?Q.type:null,nt=v(E.stencilBuffer,W),St=E.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,xt=Qt(E);ee(E)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,xt,nt,E.width,E.height):Z?i.renderbufferStorageMultisample(i.RENDERBUFFER,xt,nt,E.width,E.height):i.renderbufferStorage(i.RENDERBUFFER,nt,E.width,E.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,St,i.RENDERBUFFER,C)}else{const Q=E.textures;for(let W=0;W<Q.length;W++){const nt=Q[W],St=r.convert(nt.format,nt.colorSpace),xt=r.convert(nt.type),Tt=w(nt.internalFormat,St,xt,nt.colorSpace),Zt=Qt(E);Z&&ee(E)===!1?i.renderbufferStorageMultisample(i.RENDERBUFFER,Zt,Tt,E.width,E.height):ee(E)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,Zt,Tt,E.width,E.height):i.renderbufferStorage(i.RENDERBUFFER,Tt,E.width,E.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function zt(C,E){if(E&&E.isWebGLCubeRenderTarget)throw new Error("Depth Texture with cube render targets is not supported");if(e.bindFramebuffer(i.FRAMEBUFFER,C),!(E.depthTexture&&E.depthTexture.isDepthTexture))throw new Error("renderTarget.depthTexture must be an instance of THREE.DepthTexture");const Q=n.get(E.depthTexture);Q.__renderTarget=E,(!Q.__webglTexture||E.depthTexture.image.width!==E.width||E.depthTexture.image.height!==E.height)&&(E.depthTexture.image.width=E.width,E.depthTexture.image.height=E.height,E.depthTexture.needsUpdate=!0),X(E.depthTexture,0);const W=Q.__webglTexture,nt=Qt(E);if(E.depthTexture.format===oo)ee(E)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,i.DEPTH_ATTACHMENT,i.TEXTURE_2D,W,0,nt):i.framebufferTexture2D(i.FRAMEBUFFER,i.DEPTH_ATTACHMENT,i.TEXTURE_2D,W,0);else if(E.depthTexture.format===vo)ee(E)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,i.DEPTH_STENCIL_ATTACHMENT,i.TEXTURE_2D,W,0,nt):i.framebufferTexture2D(i.FRAMEBUFFER,i.DEPTH_STENCIL_ATTACHMENT,i.TEXTURE_2D,W,0);else throw new Error("Unknown depthTexture format")}function Ht(C){const E=n.get(C),Z=C.isWebGLCubeRenderTarget===!0;if(E.__boundDepthTexture!==C.depthTexture){const Q=C.depthTexture;if(E.__depthDisposeCallback&&E.__depthDisposeCallback(),Q){const W=()=>{delete E.__boundDepthTexture,delete E.__depthDisposeCallback,Q.removeEventListener("dispose",W)};Q.addEventListener("dispose",W),E.__depthDisposeCallback=W}E.__boundDepthTexture=Q}if(C.depthTexture&&!E.__autoAllocateDepthBuffer){if(Z)throw new Error("target.depthTexture not supported in Cube render targets");zt(E.__webglFramebuffer,C)}else if(Z){E.__webglDepthbuffer=[];for(let Q=0;Q<6;Q++)if(e.bindFramebuffer(i.FRAMEBUFFER,E.__webglFramebuffer[Q]),E.__webglDepthbuffer[Q]===void 0)E.__webglDepthbuffer[Q]=i.createRenderbuffer(),at(E.__webglDepthbuffer[Q],C,!1);else{const W=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,nt=E.__webglDepthbuffer[Q];i.bindRenderbuffer(i.RENDERBUFFER,nt),i.framebufferRenderbuffer(i.FRAMEBUFFER,W,i.RENDERBUFFER,nt)}}else if(e.bindFramebuffer(i.FRAMEBUFFER,E.__webglFramebuffer),E.__webglDepthbuffer===void 0)E.__webglDepthbuffer=i.createRenderbuffer(),at(E.__webglDepthbuffer,C,!1);else{const Q=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,W=E.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,W),i.framebufferRenderbuffer(i.FRAMEBUFFER,Q,i.RENDERBUFFER,W)}e.bindFramebuffer(i.FRAMEBUFFER,null)}function Ut(C,E,Z){const Q=n.get(C);E!==void 0&&bt(Q.__webglFramebuffer,C,C.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),Z!==void 0&&Ht(C)}function ce(C){const E=C.texture,Z=n.get(C),Q=n.get(E);C.addEventListener("dispose",L);const W=C.textures,nt=C.isWebGLCubeRenderTarget===!0,St=W.length>1;if(St||(Q.__webglTexture===void 0&&(Q.__webglTexture=i.createTexture()),Q.__version=E.version,o.memory.textures++),nt){Z.__webglFramebuffer=[];for(let xt=0;xt<6;xt++)if(E.mipmaps&&E.mipmaps.length>0){Z.__webglFramebuffer[xt]=[];for(let Tt=0;Tt<E.mipmaps.length;Tt++)Z.__webglFramebuffer[xt][Tt]=i.createFramebuffer()}else Z.__webglFramebuffer[xt]=i.createFramebuffer()}else{if(E.mipmaps&&E.mipmaps.length>0){Z.__webglFramebuffer=[];for(let xt=0;xt<E.mipmaps.length;xt++)Z.__webglFramebuffer[xt]=i.createFramebuffer()}else Z.__webglFramebuffer=i.createFramebuffer();if(St)for(let xt=0,Tt=W.length;xt<Tt;xt++){const Zt=n.get(W[xt]);Zt.__webglTexture===void 0&&(Zt.__webglTexture=i.createTexture(),o.memory.textures++)}if(C.samples>0&&ee(C)===!1){Z.__webglMultisampledFramebuffer=i.createFramebuffer(),Z.__webglColorRenderbuffer=[],e.bindFramebuffer(i.FRAMEBUFFER,Z.__webglMultisampledFramebuffer);for(let xt=0;xt<W.length;xt++){const Tt=W[xt];Z.__webglColorRenderbuffer[xt]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,Z.__webglColorRenderbuffer[xt]);const Zt=r.convert(Tt.format,Tt.colorSpace),dt=r.convert(Tt.type),Mt=w(Tt.internalFormat,Zt,dt,Tt.colorSpace,C.isXRRenderTarget===!0),Nt=Qt(C);i.renderbufferStorageMultisample(i.RENDERBUFFER,Nt,Mt,C.width,C.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+xt,i.RENDERBUFFER,Z.__webglColorRenderbuffer[xt])}i.bindRenderbuffer(i.RENDERBUFFER,null),C.depthBuffer&&(Z.__webglDepthRenderbuffer=i.createRenderbuffer(),at(Z.__webglDepthRenderbuffer,C,!0)),e.bindFramebuffer(i.FRAMEBUFFER,null)}}if(nt){e.bindTexture(i.TEXTURE_CUBE_MAP,Q.__webglTexture),vt(i.TEXTURE_CUBE_MAP,E);for(let xt=0;xt<6;xt++)if(E.mipmaps&&E.mipmaps.length>0)for(let Tt=0;Tt<E.mipmaps.length;Tt++)bt(Z.__webglFramebuffer[xt][Tt],C,E,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+xt,Tt);else bt(Z.__webglFramebuffer[xt],C,E,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+xt,0);m(E)&&d(i.TEXTURE_CUBE_MAP),e.unbindTexture()}else if(St){for(let xt=0,Tt=W.length;xt<Tt;xt++){const Zt=W[xt],dt=n.get(Zt);e.bindTexture(i.TEXTURE_2D,dt.__webglTexture),vt(i.TEXTURE_2D,Zt),bt(Z.__webglFramebuffer,C,Zt,i.COLOR_ATTACHMENT0+xt,i.TEXTURE_2D,0),m(Zt)&&d(i.TEXTURE_2D)}e.unbindTexture()}else{let xt=i.TEXTURE_2D;if((C.isWebGL3DRenderTarget||C.isWebGLArrayRenderTarget)&&(xt=C.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(xt,Q.__webglTexture),vt(xt,E),E.mipmaps&&E.mipmaps.length>0)for(let Tt=0;Tt<E.mipmaps.length;Tt++)bt(Z.__webglFramebuffer[Tt],C,E,i.COLOR_ATTACHMENT0,xt,Tt);else bt(Z.__webglFramebuffer,C,E,i.COLOR_ATTACHMENT0,xt,0);m(E)&&d(xt),e.unbindTexture()}C.depthBuffer&&Ht(C)}function Kt(C){const E=C.textures;for(let Z=0,Q=E.length;Z<Q;Z++){const W=E[Z];if(m(W)){const nt=M(C),St=n.get(W).__webglTexture;e.bindTexture(nt,St),d(nt),e.unbindTexture()}}}const he=[],H=[];function nn(C){if(C.samples>0){if(ee(C)===!1){const E=C.textures,Z=C.width,Q=C.height;let W=i.COLOR_BUFFER_BIT;const nt=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,St=n.get(C),xt=E.length>1;if(xt)for(let Tt=0;Tt<E.length;Tt++)e.bindFramebuffer(i.FRAMEBUFFER,St.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+Tt,i.RENDERBUFFER,null),e.bindFramebuffer(i.FRAMEBUFFER,St.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+Tt,i.TEXTURE_2D,null,0);e.bindFramebuffer(i.READ_FRAMEBUFFER,St.__webglMultisampledFramebuffer),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,St.__webglFramebuffer);for(let Tt=0;Tt<E.length;Tt++){if(C.resolveDepthBuffer&&(C.depthBuffer&&(W|=i.DEPTH_BUFFER_BIT),C.stencilBuffer&&C.resolveStencilBuffer&&(W|=i.STENCIL_BUFFER_BIT)),xt){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,St.__webglColorRenderbuffer[Tt]);const Zt=n.get(E[Tt]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,Zt,0)}i.blitFramebuffer(0,0,Z,Q,0,0,Z,Q,W,i.NEAREST),l===!0&&(he.length=0,H.length=0,he.push(i.COLOR_ATTACHMENT0+Tt),C.depthBuffer&&C.resolveDepthBuffer===!1&&(he.push(nt),H.push(nt),i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,H)),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,he))}if(e.bindFramebuffer(i.READ_FRAMEBUFFER,null),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),xt)for(let Tt=0;Tt<E.length;Tt++){e.bindFramebuffer(i.FRAMEBUFFER,St.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+Tt,i.RENDERBUFFER,St.__webglColorRenderbuffer[Tt]);const Zt=n.get(E[Tt]).__webglTexture;e.bindFramebuffer(i.FRAMEBUFFER,St.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+Tt,i.TEXTURE_2D,Zt,0)}e.bindFramebuffer(i.DRAW_FRAMEBUFFER,St.__webglMultisampledFramebuffer)}else if(C.depthBuffer&&C.resolveDepthBuffer===!1&&l){const E=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[E])}}}function Qt(C){return Math.min(s.maxSamples,C.samples)}function ee(C){const E=n.get(C);return C.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&E.__useRenderToTexture!==!1}function Gt(C){const E=o.render.frame;h.get(C)!==E&&(h.set(C,E),C.update())}function de(C,E){const Z=C.colorSpace,Q=C.format,W=C.type;return C.isCompressedTexture===!0||C.isVideoTexture===!0||Z!==br&&Z!==Ls&&(fe.getTransfer(Z)===Ae?(Q!==Ai||W!==_s)&&console.warn("THREE.WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):console.error("THREE.WebGLTextures: Unsupported texture color space:",Z)),E}function Lt(C){return typeof HTMLImageElement<"u"&&C instanceof HTMLImageElement?(c.width=C.naturalWidth||C.width,c.height=C.naturalHeight||C.height):typeof VideoFrame<"u"&&C instanceof VideoFrame?(c.width=C.displayWidth,c.height=C.displayHeight):(c.width=C.width,c.height=C.height),c}this.allocateTextureUnit=N,this.resetTextureUnits=V,this.setTexture2D=X,this.setTexture2DArray=J,this.setTexture3D=K,this.setTextureCube=et,this.rebindTextures=Ut,this.setupRenderTarget=ce,this.updateRenderTargetMipmap=Kt,this.updateMultisampleRenderTarget=nn,this.setupDepthRenderbuffer=Ht,this.setupFrameBufferTexture=bt,this.useMultisampledRTT=ee}function qE(i,t){function e(n,s=Ls){let r;const o=fe.getTransfer(s);if(n===_s)return i.UNSIGNED_BYTE;if(n===zu)return i.UNSIGNED_SHORT_4_4_4_4;if(n===Vu)return i.UNSIGNED_SHORT_5_5_5_1;if(n===c_)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===l_)return i.BYTE;if(n===Bu)return i.SHORT;if(n===sa)return i.UNSIGNED_SHORT;if(n===Wl)return i.INT;if(n===mr)return i.UNSIGNED_INT;if(n===Ti)return i.FLOAT;if(n===oa)return i.HALF_FLOAT;if(n===h_)return i.ALPHA;if(n===u_)return i.RGB;if(n===Ai)return i.RGBA;if(n===f_)return i.LUMINANCE;if(n===d_)return i.LUMINANCE_ALPHA;if(n===oo)return i.DEPTH_COMPONENT;if(n===vo)return i.DEPTH_STENCIL;if(n===Hu)return i.RED;if(n===Gu)return i.RED_INTEGER;if(n===p_)return i.RG;if(n===Wu)return i.RG_INTEGER;if(n===Xl)return i.RGBA_INTEGER;if(n===nl||n===il||n===sl||n===rl)if(o===Ae)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===nl)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===il)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===sl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===rl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===nl)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===il)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===sl)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===rl)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===zh||n===Vh||n===Hh||n===Gh)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===zh)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===Vh)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===Hh)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Gh)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Wh||n===Xh||n===Yh)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Wh||n===Xh)return o===Ae?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===Yh)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC}else return null;if(n===qh||n===jh||n===$h||n===Zh||n===Kh||n===Jh||n===Qh||n===tu||n===eu||n===nu||n===iu||n===su||n===ru||n===ou)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(n===qh)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===jh)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===$h)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===Zh)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Kh)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===Jh)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===Qh)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===tu)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===eu)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===nu)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===iu)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===su)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===ru)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===ou)return o===Ae?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===ol||n===au||n===lu)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(n===ol)return o===Ae?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===au)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===lu)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===m_||n===cu||n===hu||n===uu)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(n===ol)return r.COMPRESSED_RED_RGTC1_EXT;if(n===cu)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===hu)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===uu)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===bo?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:e}}class jE extends hi{constructor(t=[]){super(),this.isArrayCamera=!0,this.cameras=t}}class us extends Mn{constructor(){super(),this.isGroup=!0,this.type="Group"}}const $E={type:"move"};class Zc{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new us,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new us,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new D,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new D),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new us,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new D,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new D),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){const e=this._hand;if(e)for(const n of t.hand.values())this._getHandJoint(e,n)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,n){let s=null,r=null,o=null;const a=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){o=!0;for(const b of t.hand.values()){const m=e.getJointPose(b,n),d=this._getHandJoint(c,b);m!==null&&(d.matrix.fromArray(m.transform.matrix),d.matrix.decompose(d.position,d.rotation,d.scale),d.matrixWorldNeedsUpdate=!0,d.jointRadius=m.radius),d.visible=m!==null}const h=c.joints["index-finger-tip"],f=c.joints["thumb-tip"],u=h.position.distanceTo(f.position),p=.02,_=.005;c.inputState.pinching&&u>p+_?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&u<=p-_&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.rotation,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1));a!==null&&(s=e.getPose(t.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.rotation,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent($E)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){const n=new us;n.matrixAutoUpdate=!1,n.visible=!1,t.joints[e.jointName]=n,t.add(n)}return t.joints[e.jointName]}}const ZE=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,KE=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`;class JE{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e,n){if(this.texture===null){const s=new zn,r=t.properties.get(s);r.__webglTexture=e.texture,(e.depthNear!=n.depthNear||e.depthFar!=n.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=s}}getMesh(t){if(this.texture!==null&&this.mesh===null){const e=t.cameras[0].viewport,n=new Hi({vertexShader:ZE,fragmentShader:KE,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new Ye(new la(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}}class QE extends vr{constructor(t,e){super();const n=this;let s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,f=null,u=null,p=null,_=null;const b=new JE,m=e.getContextAttributes();let d=null,M=null;const w=[],v=[],U=new $t;let P=null;const L=new hi;L.viewport=new He;const F=new hi;F.viewport=new He;const S=[L,F],x=new jE;let A=null,V=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(st){let lt=w[st];return lt===void 0&&(lt=new Zc,w[st]=lt),lt.getTargetRaySpace()},this.getControllerGrip=function(st){let lt=w[st];return lt===void 0&&(lt=new Zc,w[st]=lt),lt.getGripSpace()},this.getHand=function(st){let lt=w[st];return lt===void 0&&(lt=new Zc,w[st]=lt),lt.getHandSpace()};function N(st){const lt=v.indexOf(st.inputSource);if(lt===-1)return;const bt=w[lt];bt!==void 0&&(bt.update(st.inputSource,st.frame,c||o),bt.dispatchEvent({type:st.type,data:st.inputSource}))}function Y(){s.removeEventListener("select",N),s.removeEventListener("selectstart",N),s.removeEventListener("selectend",N),s.removeEventListener("squeeze",N),s.removeEventListener("squeezestart",N),s.removeEventListener("squeezeend",N),s.removeEventListener("end",Y),s.removeEventListener("inputsourceschange",X);for(let st=0;st<w.length;st++){const lt=v[st];lt!==null&&(v[st]=null,w[st].disconnect(lt))}A=null,V=null,b.reset(),t.setRenderTarget(d),p=null,u=null,f=null,s=null,M=null,pt.stop(),n.isPresenting=!1,t.setPixelRatio(P),t.setSize(U.width,U.height,!1),n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(st){r=st,n.isPresenting===!0&&console.warn("THREE.WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(st){a=st,n.isPresenting===!0&&console.warn("THREE.WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(st){c=st},this.getBaseLayer=function(){return u!==null?u:p},this.getBinding=function(){return f},this.getFrame=function(){return _},this.getSession=function(){return s},this.setSession=async function(st){if(s=st,s!==null){if(d=t.getRenderTarget(),s.addEventListener("select",N),s.addEventListener("selectstart",N),s.addEventListener("selectend",N),s.addEventListener("squeeze",N),s.addEventListener("squeezestart",N),s.addEventListener("squeezeend",N),s.addEventListener("end",Y),s.addEventListener("inputsourceschange",X),m.xrCompatible!==!0&&await e.makeXRCompatible(),P=t.getPixelRatio(),t.getSize(U),s.renderState.layers===void 0){const lt={antialias:m.antialias,alpha:!0,depth:m.depth,stencil:m.stencil,framebufferScaleFactor:r};p=new XRWebGLLayer(s,e,lt),s.updateRenderState({baseLayer:p}),t.setPixelRatio(1),t.setSize(p.framebufferWidth,p.framebufferHeight,!1),M=new Ds(p.framebufferWidth,p.framebufferHeight,{format:Ai,type:_s,colorSpace:t.outputColorSpace,stencilBuffer:m.stencil})}else{let lt=null,bt=null,at=null;m.depth&&(at=m.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,lt=m.stencil?vo:oo,bt=m.stencil?bo:mr);const zt={colorFormat:e.RGBA8,depthFormat:at,scaleFactor:r};f=new XRWebGLBinding(s,e),u=f.createProjectionLayer(zt),s.updateRenderState({layers:[u]}),t.setPixelRatio(1),t.setSize(u.textureWidth,u.textureHeight,!1),M=new Ds(u.textureWidth,u.textureHeight,{format:Ai,type:_s,depthTexture:new R_(u.textureWidth,u.textureHeight,bt,void 0,void 0,void 0,void 0,void 0,void 0,lt),stencilBuffer:m.stencil,colorSpace:t.outputColorSpace,samples:m.antialias?4:0,resolveDepthBuffer:u.ignoreDepthValues===!1})}M.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),pt.setContext(s),pt.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return b.getDepthTexture()};function X(st){for(let lt=0;lt<st.removed.length;lt++){const bt=st.removed[lt],at=v.indexOf(bt);at>=0&&(v[at]=null,w[at].disconnect(bt))}for(let lt=0;lt<st.added.length;lt++){const bt=st.added[lt];let at=v.indexOf(bt);if(at===-1){for(let Ht=0;Ht<w.length;Ht++)if(Ht>=v.length){v.push(bt),at=Ht;break}else if(v[Ht]===null){v[Ht]=bt,at=Ht;break}if(at===-1)break}const zt=w[at];zt&&zt.connect(bt)}}const J=new D,K=new D;function et(st,lt,bt){J.setFromMatrixPosition(lt.matrixWorld),K.setFromMatrixPosition(bt.matrixWorld);const at=J.distanceTo(K),zt=lt.projectionMatrix.elements,Ht=bt.projectionMatrix.elements,Ut=zt[14]/(zt[10]-1),ce=zt[14]/(zt[10]+1),Kt=(zt[9]+1)/zt[5],he=(zt[9]-1)/zt[5],H=(zt[8]-1)/zt[0],nn=(Ht[8]+1)/Ht[0],Qt=Ut*H,ee=Ut*nn,Gt=at/(-H+nn),de=Gt*-H;if(lt.matrixWorld.decompose(st.position,st.quaternion,st.scale),st.translateX(de),st.translateZ(Gt),st.matrixWorld.compose(st.position,st.quaternion,st.scale),st.matrixWorldInverse.copy(st.matrixWorld).invert(),zt[10]===-1)st.projectionMatrix.copy(lt.projectionMatrix),st.projectionMatrixInverse.copy(lt.projectionMatrixInverse);else{const Lt=Ut+Gt,C=ce+Gt,E=Qt-de,Z=ee+(at-de),Q=Kt*ce/C*Lt,W=he*ce/C*Lt;st.projectionMatrix.makePerspective(E,Z,Q,W,Lt,C),st.projectionMatrixInverse.copy(st.projectionMatrix).invert()}}function ct(st,lt){lt===null?st.matrixWorld.copy(st.matrix):st.matrixWorld.multiplyMatrices(lt.matrixWorld,st.matrix),st.matrixWorldInverse.copy(st.matrixWorld).invert()}this.updateCamera=function(st){if(s===null)return;let lt=st.near,bt=st.far;b.texture!==null&&(b.depthNear>0&&(lt=b.depthNear),b.depthFar>0&&(bt=b.depthFar)),x.near=F.near=L.near=lt,x.far=F.far=L.far=bt,(A!==x.near||V!==x.far)&&(s.updateRenderState({depthNear:x.near,depthFar:x.far}),A=x.near,V=x.far),L.layers.mask=st.layers.mask|2,F.layers.mask=st.layers.mask|4,x.layers.mask=L.layers.mask|F.layers.mask;const at=st.parent,zt=x.cameras;ct(x,at);for(let Ht=0;Ht<zt.length;Ht++)ct(zt[Ht],at);zt.length===2?et(x,L,F):x.projectionMatrix.copy(L.projectionMatrix),ht(st,x,at)};function ht(st,lt,bt){bt===null?st.matrix.copy(lt.matrixWorld):(st.matrix.copy(bt.matrixWorld),st.matrix.invert(),st.matrix.multiply(lt.matrixWorld)),st.matrix.decompose(st.position,st.quaternion,st.scale),st.updateMatrixWorld(!0),st.projectionMatrix.copy(lt.projectionMatrix),st.projectionMatrixInverse.copy(lt.projectionMatrixInverse),st.isPerspectiveCamera&&(st.fov=fu*2*Math.atan(1/st.projectionMatrix.elements[5]),st.zoom=1)}this.getCamera=function(){return x},this.getFoveation=function(){if(!(u===null&&p===null))return l},this.setFoveation=function(st){l=st,u!==null&&(u.fixedFoveation=st),p!==null&&p.fixedFoveation!==void 0&&(p.fixedFoveation=st)},this.hasDepthSensing=function(){return b.texture!==null},this.getDepthSensingMesh=function(){return b.getMesh(x)};let _t=null;function vt(st,lt){if(h=lt.getViewerPose(c||o),_=lt,h!==null){const bt=h.views;p!==null&&(t.setRenderTargetFramebuffer(M,p.framebuffer),t.setRenderTarget(M));let at=!1;bt.length!==x.cameras.length&&(x.cameras.length=0,at=!0);for(let Ht=0;Ht<bt.length;Ht++){const Ut=bt[Ht];let ce=null;if(p!==null)ce=p.getViewport(Ut);else{const he=f.getViewSubImage(u,Ut);ce=he.viewport,Ht===0&&(t.setRenderTargetTextures(M,he.colorTexture,u.ignoreDepthValues?void 0:he.depthStencilTexture),t.setRenderTarget(M))}let Kt=S[Ht];Kt===void 0&&(Kt=new hi,Kt.layers.enable(Ht),Kt.viewport=new He,S[Ht]=Kt),Kt.matrix.fromArray(Ut.transform.matrix),Kt.matrix.decompose(Kt.position,Kt.quaternion,Kt.scale),Kt.projectionMatrix.fromArray(Ut.projectionMatrix),Kt.projectionMatrixInverse.copy(Kt.projectionMatrix).invert(),Kt.viewport.set(ce.x,ce.y,ce.width,ce.height),Ht===0&&(x.matrix.copy(Kt.matrix),x.matrix.decompose(x.position,x.quaternion,x.scale)),at===!0&&x.cameras.push(Kt)}const zt=s.enabledFeatures;if(zt&&zt.includes("depth-sensing")){const Ht=f.getDepthInformation(bt[0]);Ht&&Ht.isValid&&Ht.texture&&b.init(t,Ht,s.renderState)}}for(let bt=0;bt<w.length;bt++){const at=v[bt],zt=w[bt];at!==null&&zt!==void 0&&zt.update(at,lt,c||o)}_t&&_t(st,lt),lt.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:lt}),_=null}const pt=new T_;pt.setAnimationLoop(vt),this.setAnimationLoop=function(st){_t=st},this.dispose=function(){}}}const $s=new gs,t1=new Pe;function e1(i,t){function e(m,d){m.matrixAutoUpdate===!0&&m.updateMatrix(),d.value.copy(m.matrix)}function n(m,d){d.color.getRGB(m.fogColor.value,w_(i)),d.isFog?(m.fogNear.value=d.near,m.fogFar.value=d.far):d.isFogExp2&&(m.fogDensity.value=d.density)}function s(m,d,M,w,v){d.isMeshBasicMaterial||d.isMeshLambertMaterial?r(m,d):d.isMeshToonMaterial?(r(m,d),f(m,d)):d.isMeshPhongMaterial?(r(m,d),h(m,d)):d.isMeshStandardMaterial?(r(m,d),u(m,d),d.isMeshPhysicalMaterial&&p(m,d,v)):d.isMeshMatcapMaterial?(r(m,d),_(m,d)):d.isMeshDepthMaterial?r(m,d):d.isMeshDistanceMaterial?(r(m,d),b(m,d)):d.isMeshNormalMaterial?r(m,d):d.isLineBasicMaterial?(o(m,d),d.isLineDashedMaterial&&a(m,d)):d.isPointsMaterial?l(m,d,M,w):d.isSpriteMaterial?c(m,d):d.isShadowMaterial?(m.color.value.copy(d.color),m.opacity.value=d.opacity):d.isShaderMaterial&&(d.uniformsNeedUpdate=!1)}function r(m,d){m.opacity.value=d.opacity,d.color&&m.diffuse.value.copy(d.color),d.emissive&&m.emissive.value.copy(d.emissive).multiplyScalar(d.emissiveIntensity),d.map&&(m.map.value=d.map,e(d.map,m.mapTransform)),d.alphaMap&&(m.alphaMap.value=d.alphaMap,e(d.alphaMap,m.alphaMapTransform)),d.bumpMap&&(m.bumpMap.value=d.bumpMap,e(d.bumpMap,m.bumpMapTransform),m.bumpScale.value=d.bumpScale,d.side===Cn&&(m.bumpScale.value*=-1)),d.normalMap&&(m.normalMap.value=d.normalMap,e(d.normalMap,m.normalMapTransform),m.normalScale.value.copy(d.normalScale),d.side===Cn&&m.normalScale.value.negate()),d.displacementMap&&(m.displacementMap.value=d.displacementMap,e(d.displacementMap,m.displacementMapTransform),m.displacementScale.value=d.displacementScale,m.displacementBias.value=d.displacementBias),d.emissiveMap&&(m.emissiveMap.value=d.emissiveMap,e(d.emissiveMap,m.emissiveMapTransform)),d.specularMap&&(m.specularMap.value=d.specularMap,e(d.specularMap,m.specularMapTransform)),d.alphaTest>0&&(m.alphaTest.value=d.alphaTest);const M=t.get(d),w=M.envMap,v=M.envMapRotation;w&&(m.envMap.value=w,$s.copy(v),$s.x*=-1,$s.y*=-1,$s.z*=-1,w.isCubeTexture&&w.isRenderTargetTexture===!1&&($s.y*=-1,$s.z*=-1),m.envMapRotation.value.setFromMatrix4(t1.makeRotationFromEuler($s)),m.flipEnvMap.value=w.isCubeTexture&&w.isRenderTargetTexture===!1?-1:1,m.reflectivity.value=d.reflectivity,m.ior.value=d.ior,m.refractionRatio.value=d.refractionRatio),d.lightMap&&(m.lightMap.value=d.lightMap,m.lightMapIntensity.value=d.lightMapIntensity,e(d.lightMap,m.lightMapTransform)),d.aoMap&&(m.aoMap.value=d.aoMap,m.aoMapIntensity.value=d.aoMapIntensity,e(d.aoMap,m.aoMapTransform))}function o(m,d){m.diffuse.value.copy(d.color),m.opacity.value=d.opacity,d.map&&(m.map.value=d.map,e(d.map,m.mapTransform))}function a(m,d){m.dashSize.value=d.dashSize,m.totalSize.value=d.dashSize+d.gapSize,m.scale.value=d.scale}function l(m,d,M,w){m.diffuse.value.copy(d.color),m.opacity.value=d.opacity,m.size.value=d.size*M,m.scale.value=w*.5,d.map&&(m.map.value=d.map,e(d.map,m.uvTransform)),d.alphaMap&&(m.alphaMap.value=d.alphaMap,e(d.alphaMap,m.alphaMapTransform)),d.alphaTest>0&&(m.alphaTest.value=d.alphaTest)}function c(m,d){m.diffuse.value.copy(d.color),m.opacity.value=d.opacity,m.rotation.value=d.rotation,d.map&&(m.map.value=d.map,e(d.map,m.mapTransform)),d.alphaMap&&(m.alphaMap.value=d.alphaMap,e(d.alphaMap,m.alphaMapTransform)),d.alphaTest>0&&(m.alphaTest.value=d.alphaTest)}function h(m,d){m.specular.value.copy(d.specular),m.shininess.value=Math.max(d.shininess,1e-4)}function f(m,d){d.gradientMap&&(m.gradientMap.value=d.gradientMap)}function u(m,d){m.metalness.value=d.metalness,d.metalnessMap&&(m.metalnessMap.value=d.metalnessMap,e(d.metalnessMap,m.metalnessMapTransform)),m.roughness.value=d.roughness,d.roughnessMap&&(m.roughnessMap.value=d.roughnessMap,e(d.roughnessMap,m.roughnessMapTransform)),d.envMap&&(m.envMapIntensity.value=d.envMapIntensity)}function p(m,d,M){m.ior.value=d.ior,d.sheen>0&&(m.sheenColor.value.copy(d.sheenColor).multiplyScalar(d.sheen),m.sheenRoughness.value=d.sheenRoughness,d.sheenColorMap&&(m.sheenColorMap.value=d.sheenColorMap,e(d.sheenColorMap,m.sheenColorMapTransform)),d.sheenRoughnessMap&&(m.sheenRoughnessMap.value=d.sheenRoughnessMap,e(d.sheenRoughnessMap,m.sheenRoughnessMapTransform))),d.clearcoat>0&&(m.clearcoat.value=d.clearcoat,m.clearcoatRoughness.value=d.clearcoatRoughness,d.clearcoatMap&&(m.clearcoatMap.value=d.clearcoatMap,e(d.clearcoatMap,m.clearcoatMapTransform)),d.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=d.clearcoatRoughnessMap,e(d.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),d.clearcoatNormalMap&&(m.clearcoatNormalMap.value=d.clearcoatNormalMap,e(d.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(d.clearcoatNormalScale),d.side===Cn&&m.clearcoatNormalScale.value.negate())),d.dispersion>0&&(m.dispersion.value=d.dispersion),d.iridescence>0&&(m.iridescence.value=d.iridescence,m.iridescenceIOR.value=d.iridescenceIOR,m.iridescenceThicknessMinimum.value=d.iridescenceThicknessRange[0],m.iridescenceThicknessMaximum.value=d.iridescenceThicknessRange[1],d.iridescenceMap&&(m.iridescenceMap.value=d.iridescenceMap,e(d.iridescenceMap,m.iridescenceMapTransform)),d.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=d.iridescenceThicknessMap,e(d.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),d.transmission>0&&(m.transmission.value=d.transmission,m.transmissionSamplerMap.value=M.texture,m.transmissionSamplerSize.value.set(M.width,M.height),d.transmissionMap&&(m.transmissionMap.value=d.transmissionMap,e(d.transmissionMap,m.transmissionMapTransform)),m.thickness.value=d.thickness,d.thicknessMap&&(m.thicknessMap.value=d.thicknessMap,e(d.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=d.attenuationDistance,m.attenuationColor.value.copy(d.attenuationColor)),d.anisotropy>0&&(m.anisotropyVector.value.set(d.anisotropy*Math.cos(d.anisotropyRotation),d.anisotropy*Math.sin(d.anisotropyRotation)),d.anisotropyMap&&(m.anisotropyMap.value=d.anisotropyMap,e(d.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=d.specularIntensity,m.specularColor.value.copy(d.specularColor),d.specularColorMap&&(m.specularColorMap.value=d.specularColorMap,e(d.specularColorMap,m.specularColorMapTransform)),d.specularIntensityMap&&(m.specularIntensityMap.value=d.specularIntensityMap,e(d.specularIntensityMap,m.specularIntensityMapTransform))}function _(m,d){d.matcap&&(m.matcap.value=d.matcap)}function b(m,d){const M=t.get(d).light;m.referencePosition.value.setFromMatrixPosition(M.matrixWorld),m.nearDistance.value=M.shadow.camera.near,m.farDistance.value=M.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function n1(i,t,e,n){let s={},r={},o=[];const a=i.getParameter(i.MAX_UNIFORM_BUFFER_BINDINGS);function l(M,w){const v=w.program;n.uniformBlockBinding(M,v)}function c(M,w){let v=s[M.id];v===void 0&&(_(M),v=h(M),s[M.id]=v,M.addEventListener("dispose",m));const U=w.program;n.updateUBOMapping(M,U);const P=t.render.frame;r[M.id]!==P&&(u(M),r[M.id]=P)}function h(M){const w=f();M.__bindingPointIndex=w;const v=i.createBuffer(),U=M.__size,P=M.usage;return i.bindBuffer(i.UNIFORM_BUFFER,v),i.bufferData(i.UNIFORM_BUFFER,U,P),i.bindBuffer(i.UNIFORM_BUFFER,null),i.bindBufferBase(i.UNIFORM_BUFFER,w,v),v}function f(){for(let M=0;M<a;M++)if(o.indexOf(M)===-1)return o.push(M),M;return console.error("THREE.WebGLRenderer: Maximum number of simultaneously usable uniforms groups reached."),0}function u(M){const w=s[M.id],v=M.uniforms,U=M.__cache;i.bindBuffer(i.UNIFORM_BUFFER,w);for(let P=0,L=v.length;P<L;P++){const F=Array.isArray(v[P])?v[P]:[v[P]];for(let S=0,x=F.length;S<x;S++){const A=F[S];if(p(A,P,S,U)===!0){const V=A.__offset,N=Array.isArray(A.value)?A.value:[A.value];let Y=0;for(let X=0;X<N.length;X++){const J=N[X],K=b(J);typeof J=="number"||typeof J=="boolean"?(A.__data[0]=J,i.bufferSubData(i.UNIFORM_BUFFER,V+Y,A.__data)):J.isMatrix3?(A.__data[0]=J.elements[0],A.__data[1]=J.elements[1],A.__data[2]=J.elements[2],A.__data[3]=0,A.__data[4]=J.elements[3],A.__data[5]=J.elements[4],A.__data[6]=J.elements[5],A.__data[7]=0,A.__data[8]=J.elements[6],A.__data[9]=J.elements[7],A.__data[10]=J.elements[8],A.__data[11]=0):(J.toArray(A.__data,Y),Y+=K.storage/Float32Array.BYTES_PER_ELEMENT)}i.bufferSubData(i.UNIFORM_BUFFER,V,A.__data)}}}i.bindBuffer(i.UNIFORM_BUFFER,null)}function p(M,w,v,U){const P=M.value,L=w+"_"+v;if(U[L]===void 0)return typeof P=="number"||typeof P=="boolean"?U[L]=P:U[L]=P.clone(),!0;{const F=U[L];if(typeof P=="number"||typeof P=="boolean"){if(F!==P)return U[L]=P,!0}else if(F.equals(P)===!1)return F.copy(P),!0}return!1}function _(M){const w=M.uniforms;let v=0;const U=16;for(let L=0,F=w.length;L<F;L++){const S=Array.isArray(w[L])?w[L]:[w[L]];for(let x=0,A=S.length;x<A;x++){const V=S[x],N=Array.isArray(V.value)?V.value:[V.value];for(let Y=0,X=N.length;Y<X;Y++){const J=N[Y],K=b(J),et=v%U,ct=et%K.boundary,ht=et+ct;v+=ct,ht!==0&&U-ht<K.storage&&(v+=U-ht),V.__data=new Float32Array(K.storage/Float32Array.BYTES_PER_ELEMENT),V.__offset=v,v+=K.storage}}}const P=v%U;return P>0&&(v+=U-P),M.__size=v,M.__cache={},this}function b(M){const w={boundary:0,storage:0};return typeof M=="number"||typeof M=="boolean"?(w.boundary=4,w.storage=4):M.isVector2?(w.boundary=8,w.storage=8):M.isVector3||M.isColor?(w.boundary=16,w.storage=12):M.isVector4?(w.boundary=16,w.storage=16):M.isMatrix3?(w.boundary=48,w.storage=48):M.isMatrix4?(w.boundary=64,w.storage=64):M.isTexture?console.warn("THREE.WebGLRenderer: Texture samplers can not be part of an uniforms group."):console.warn("THREE.WebGLRenderer: Unsupported uniform value type.",M),w}function m(M){const w=M.target;w.removeEventListener("dispose",m);const v=o.indexOf(w.__bindingPointIndex);o.splice(v,1),i.deleteBuffer(s[w.id]),delete s[w.id],delete r[w.id]}function d(){for(const M in s)i.deleteBuffer(s[M]);o=[],s={},r={}}return{bind:l,update:c,dispose:d}}class i1{constructor(t={}){const{canvas:e=Yx(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:f=!1,reverseDepthBuffer:u=!1}=t;this.isWebGLRenderer=!0;let p;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");p=n.getContextAttributes().alpha}else p=o;const _=new Uint32Array(4),b=new Int32Array(4);let m=null,d=null;const M=[],w=[];this.domElement=e,this.debug={checkShaderErrors:!0,onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this._outputColorSpace=ci,this.toneMapping=Is,this.toneMappingExposure=1;const v=this;let U=!1,P=0,L=0,F=null,S=-1,x=null;const A=new He,V=new He;let N=null;const Y=new re(0);let X=0,J=e.width,K=e.height,et=1,ct=null,ht=null;const _t=new He(0,0,J,K),vt=new He(0,0,J,K);let pt=!1;const st=new qu;let lt=!1,bt=!1;const at=new Pe,zt=new Pe,Ht=new D,Ut=new He,ce={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0};let Kt=!1;function he(){return F===null?et:1}let H=n;function nn(T,B){return e.getContext(T,B)}try{const T={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:f};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${Ou}`),e.addEventListener("webglcontextlost",ot,!1),e.addEventListener("webglcontextrestored",At,!1),e.addEventListener("webglcontextcreationerror",Rt,!1),H===null){const B="webgl2";if(H=nn(B,T),H===null)throw nn(B)?new Error("Error creating WebGL context with your selected attributes."):new Error("Error creating WebGL context.")}}catch(T){throw console.error("THREE.WebGLRenderer: "+T.message),T}let Qt,ee,Gt,de,Lt,C,E,Z,Q,W,nt,St,xt,Tt,Zt,dt,Mt,Nt,kt,Et,ie,qt,pe,z;function yt(){Qt=new lw(H),Qt.init(),qt=new qE(H,Qt),ee=new nw(H,Qt,t,qt),Gt=new WE(H,Qt),ee.reverseDepthBuffer&&u&&Gt.buffers.depth.setReversed(!0),de=new uw(H),Lt=new PE,C=new YE(H,Qt,Gt,Lt,ee,qt,de),E=new sw(v),Z=new aw(v),Q=new bM(H),pe=new tw(H,Q),W=new cw(H,Q,de,pe),nt=new dw(H,W,Q,de),kt=new fw(H,ee,C),dt=new iw(Lt),St=new RE(v,E,Z,Qt,ee,pe,dt),xt=new e1(v,Lt),Tt=new LE,Zt=new OE(Qt),Nt=new QS(v,E,Z,Gt,nt,p,l),Mt=new HE(v,nt,ee),z=new n1(H,de,ee,Gt),Et=new ew(H,Qt,de),ie=new hw(H,Qt,de),de.programs=St.programs,v.capabilities=ee,v.extensions=Qt,v.properties=Lt,v.renderLists=Tt,v.shadowMap=Mt,v.state=Gt,v.info=de}yt();const it=new QE(v,H);this.xr=it,this.getContext=function(){return H},this.getContextAttributes=function(){return H.getContextAttributes()},this.forceContextLoss=function(){const T=Qt.get("WEBGL_lose_context");T&&T.loseContext()},this.forceContextRestore=function(){const T=Qt.get("WEBGL_lose_context");T&&T.restoreContext()},this.getPixelRatio=function(){return et},this.setPixelRatio=function(T){T!==void 0&&(et=T,this.setSize(J,K,!1))},this.getSize=function(T){return T.set(J,K)},this.setSize=function(T,B,q=!0){if(it.isPresenting){console.warn("THREE.WebGLRenderer: Can't change size while VR device is presenting.");return}J=T,K=B,e.width=Math.floor(T*et),e.height=Math.floor(B*et),q===!0&&(e.style.width=T+"px",e.style.height=B+"px"),this.setViewport(0,0,T,B)},this.getDrawingBufferSize=function(T){return T.set(J*et,K*et).floor()},this.setDrawingBufferSize=function(T,B,q){J=T,K=B,et=q,e.width=Math.floor(T*q),e.height=Math.floor(B*q),this.setViewport(0,0,T,B)},this.getCurrentViewport=function(T){return T.copy(A)},this.getViewport=function(T){return T.copy(_t)},this.setViewport=function(T,B,q,j){T.isVector4?_t.set(T.x,T.y,T.z,T.w):_t.set(T,B,q,j),Gt.viewport(A.copy(_t).multiplyScalar(et).round())},this.getScissor=function(T){return T.copy(vt)},this.setScissor=function(T,B,q,j){T.isVector4?vt.set(T.x,T.y,T.z,T.w):vt.set(T,B,q,j),Gt.scissor(V.copy(vt).multiplyScalar(et).round())},this.getScissorTest=function(){return pt},this.setScissorTest=function(T){Gt.setScissorTest(pt=T)},this.setOpaqueSort=function(T){ct=T},this.setTransparentSort=function(T){ht=T},this.getClearColor=function(T){return T.copy(Nt.getClearColor())},this.setClearColor=function(){Nt.setClearColor.apply(Nt,arguments)},this.getClearAlpha=function(){return Nt.getClearAlpha()},this.setClearAlpha=function(){Nt.setClearAlpha.apply(Nt,arguments)},this.clear=function(T=!0,B=!0,q=!0){let j=0;if(T){let G=!1;if(F!==null){const ft=F.texture.format;G=ft===Xl||ft===Wu||ft===Gu}if(G){const ft=F.texture.type,wt=ft===_s||ft===mr||ft===sa||ft===bo||ft===zu||ft===Vu,Ot=Nt.getClearColor(),Ft=Nt.getClearAlpha(),Wt=Ot.r,Yt=Ot.g,Dt=Ot.b;wt?(_[0]=Wt,_[1]=Yt,_[2]=Dt,_[3]=Ft,H.clearBufferuiv(H.COLOR,0,_)):(b[0]=Wt,b[1]=Yt,b[2]=Dt,b[3]=Ft,H.clearBufferiv(H.COLOR,0,b))}else j|=H.COLOR_BUFFER_BIT}B&&(j|=H.DEPTH_BUFFER_BIT),q&&(j|=H.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),H.clear(j)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.dispose=function(){e.removeEventListener("webglcontextlost",ot,!1),e.removeEventListener("webglcontextrestored",At,!1),e.removeEventListener("webglcontextcreationerror",Rt,!1),Tt.dispose(),Zt.dispose(),Lt.dispose(),E.dispose(),Z.dispose(),nt.dispose(),pe.dispose(),z.dispose(),St.dispose(),it.dispose(),it.removeEventListener("sessionstart",Xn),it.removeEventListener("sessionend",Gi),Vn.stop()};function ot(T){T.preventDefault(),console.log("THREE.WebGLRenderer: Context Lost."),U=!0}function At(){console.log("THREE.WebGLRenderer: Context Restored."),U=!1;const T=de.autoReset,B=Mt.enabled,q=Mt.autoUpdate,j=Mt.needsUpdate,G=Mt.type;yt(),de.autoReset=T,Mt.enabled=B,Mt.autoUpdate=q,Mt.needsUpdate=j,Mt.type=G}function Rt(T){console.error("THREE.WebGLRenderer: A WebGL context could not be created. Reason: ",T.statusMessage)}function Jt(T){const B=T.target;B.removeEventListener("dispose",Jt),Be(B)}function Be(T){dn(T),Lt.remove(T)}function dn(T){const B=Lt.get(T).programs;B!==void 0&&(B.forEach(function(q){St.releaseProgram(q)}),T.isShaderMaterial&&St.releaseShaderCache(T))}this.renderBufferDirect=function(T,B,q,j,G,ft){B===null&&(B=ce);const wt=G.isMesh&&G.matrixWorld.determinant()<0,Ot=Jl(T,B,q,j,G);Gt.setMaterial(j,wt);let Ft=q.index,Wt=1;if(j.wireframe===!0){if(Ft=W.getWireframeAttribute(q),Ft===void 0)return;Wt=2}const Yt=q.drawRange,Dt=q.attributes.position;let oe=Yt.start*Wt,Me=(Yt.start+Yt.count)*Wt;ft!==null&&(oe=Math.max(oe,ft.start*Wt),Me=Math.min(Me,(ft.start+ft.count)*Wt)),Ft!==null?(oe=Math.max(oe,0),Me=Math.min(Me,Ft.count)):Dt!=null&&(oe=Math.max(oe,0),Me=Math.min(Me,Dt.count));const Se=Me-oe;if(Se<0||Se===1/0)return;pe.setup(G,j,Ot,q,Ft);let pn,ue=Et;if(Ft!==null&&(pn=Q.get(Ft),ue=ie,ue.setIndex(pn)),G.isMesh)j.wireframe===!0?(Gt.setLineWidth(j.wireframeLinewidth*he()),ue.setMode(H.LINES)):ue.setMode(H.TRIANGLES);else if(G.isLine){let Bt=j.linewidth;Bt===void 0&&(Bt=1),Gt.setLineWidth(Bt*he()),G.isLineSegments?ue.setMode(H.LINES):G.isLineLoop?ue.setMode(H.LINE_LOOP):ue.setMode(H.LINE_STRIP)}else G.isPoints?ue.setMode(H.POINTS):G.isSprite&&ue.setMode(H.TRIANGLES);if(G.isBatchedMesh)if(G._multiDrawInstances!==null)ue.renderMultiDrawInstances(G._multiDrawStarts,G._multiDrawCounts,G._multiDrawCount,G._multiDrawInstances);else if(Qt.get("WEBGL_multi_draw"))ue.renderMultiDraw(G._multiDrawStarts,G._multiDrawCounts,G._multiDrawCount);else{const Bt=G._multiDrawStarts,ze=G._multiDrawCounts,me=G._multiDrawCount,Hn=Ft?Q.get(Ft).bytesPerElement:1,Pi=Lt.get(j).currentProgram.getUniforms();for(let wn=0;wn<me;wn++)Pi.setValue(H,"_gl_DrawID",wn),ue.render(Bt[wn]/Hn,ze[wn])}else if(G.isInstancedMesh)ue.renderInstances(oe,Se,G.count);else if(q.isInstancedBufferGeometry){const Bt=q._maxInstanceCount!==void 0?q._maxInstanceCount:1/0,ze=Math.min(q.instanceCount,Bt);ue.renderInstances(oe,Se,ze)}else ue.render(oe,Se)};function be(T,B,q){T.transparent===!0&&T.side===ui&&T.forceSinglePass===!1?(T.side=Cn,T.needsUpdate=!0,Mr(T,B,q),T.side=Vi,T.needsUpdate=!0,Mr(T,B,q),T.side=ui):Mr(T,B,q)}this.compile=function(T,B,q=null){q===null&&(q=T),d=Zt.get(q),d.init(B),w.push(d),q.traverseVisible(function(G){G.isLight&&G.layers.test(B.layers)&&(d.pushLight(G),G.castShadow&&d.pushShadow(G))}),T!==q&&T.traverseVisible(function(G){G.isLight&&G.layers.test(B.layers)&&(d.pushLight(G),G.castShadow&&d.pushShadow(G))}),d.setupLights();const j=new Set;return T.traverse(function(G){if(!(G.isMesh||G.isPoints||G.isLine||G.isSprite))return;const ft=G.material;if(ft)if(Array.isArray(ft))for(let wt=0;wt<ft.length;wt++){const Ot=ft[wt];be(Ot,q,G),j.add(Ot)}else be(ft,q,G),j.add(ft)}),w.pop(),d=null,j},this.compileAsync=function(T,B,q=null){const j=this.compile(T,B,q);return new Promise(G=>{function ft(){if(j.forEach(function(wt){Lt.get(wt).currentProgram.isReady()&&j.delete(wt)}),j.size===0){G(T);return}setTimeout(ft,10)}Qt.get("KHR_parallel_shader_compile")!==null?ft():setTimeout(ft,10)})};let sn=null;function De(T){sn&&sn(T)}function Xn(){Vn.stop()}function Gi(){Vn.start()}const Vn=new T_;Vn.setAnimationLoop(De),typeof self<"u"&&Vn.setContext(self),this.setAnimationLoop=function(T){sn=T,it.setAnimationLoop(T),T===null?Vn.stop():Vn.start()},it.addEventListener("sessionstart",Xn),it.addEventListener("sessionend",Gi),this.render=function(T,B){if(B!==void 0&&B.isCamera!==!0){console.error("THREE.WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(U===!0)return;if(T.matrixWorldAutoUpdate===!0&&T.updateMatrixWorld(),B.parent===null&&B.matrixWorldAutoUpdate===!0&&B.updateMatrixWorld(),it.enabled===!0&&it.isPresenting===!0&&(it.cameraAutoUpdate===!0&&it.updateCamera(B),B=it.getCamera()),T.isScene===!0&&T.onBeforeRender(v,T,B,F),d=Zt.get(T,w.length),d.init(B),w.push(d),zt.multiplyMatrices(B.projectionMatrix,B.matrixWorldInverse),st.setFromProjectionMatrix(zt),bt=this.localClippingEnabled,lt=dt.init(this.clippingPlanes,bt),m=Tt.get(T,M.length),m.init(),M.push(m),it.enabled===!0&&it.isPresenting===!0){const ft=v.xr.getDepthSensingMesh();ft!==null&&Sn(ft,B,-1/0,v.sortObjects)}Sn(T,B,0,v.sortObjects),m.finish(),v.sortObjects===!0&&m.sort(ct,ht),Kt=it.enabled===!1||it.isPresenting===!1||it.hasDepthSensing()===!1,Kt&&Nt.addToRenderList(m,T),this.info.render.frame++,lt===!0&&dt.beginShadows();const q=d.state.shadowsArray;Mt.render(q,T,B),lt===!0&&dt.endShadows(),this.info.autoReset===!0&&this.info.reset();const j=m.opaque,G=m.transmissive;if(d.setupLights(),B.isArrayCamera){const ft=B.cameras;if(G.length>0)for(let wt=0,Ot=ft.length;wt<Ot;wt++){const Ft=ft[wt];Xi(j,G,T,Ft)}Kt&&Nt.render(T);for(let wt=0,Ot=ft.length;wt<Ot;wt++){const Ft=ft[wt];Wi(m,T,Ft,Ft.viewport)}}else G.length>0&&Xi(j,G,T,B),Kt&&Nt.render(T),Wi(m,T,B);F!==null&&(C.updateMultisampleRenderTarget(F),C.updateRenderTargetMipmap(F)),T.isScene===!0&&T.onAfterRender(v,T,B),pe.resetDefaultState(),S=-1,x=null,w.pop(),w.length>0?(d=w[w.length-1],lt===!0&&dt.setGlobalState(v.clippingPlanes,d.state.camera)):d=null,M.pop(),M.length>0?m=M[M.length-1]:m=null};function Sn(T,B,q,j){if(T.visible===!1)return;if(T.layers.test(B.layers)){if(T.isGroup)q=T.renderOrder;else if(T.isLOD)T.autoUpdate===!0&&T.update(B);else if(T.isLight)d.pushLight(T),T.castShadow&&d.pushShadow(T);else if(T.isSprite){if(!T.frustumCulled||st.intersectsSprite(T)){j&&Ut.setFromMatrixPosition(T.matrixWorld).applyMatrix4(zt);const wt=nt.update(T),Ot=T.material;Ot.visible&&m.push(T,wt,Ot,q,Ut.z,null)}}else if((T.isMesh||T.isLine||T.isPoints)&&(!T.frustumCulled||st.intersectsObject(T))){const wt=nt.update(T),Ot=T.material;if(j&&(T.boundingSphere!==void 0?(T.boundingSphere===null&&T.computeBoundingSphere(),Ut.copy(T.boundingSphere.center)):(wt.boundingSphere===null&&wt.computeBoundingSphere(),Ut.copy(wt.boundingSphere.center)),Ut.applyMatrix4(T.matrixWorld).applyMatrix4(zt)),Array.isArray(Ot)){const Ft=wt.groups;for(let Wt=0,Yt=Ft.length;Wt<Yt;Wt++){const Dt=Ft[Wt],oe=Ot[Dt.materialIndex];oe&&oe.visible&&m.push(T,wt,oe,q,Ut.z,Dt)}}else Ot.visible&&m.push(T,wt,Ot,q,Ut.z,null)}}const ft=T.children;for(let wt=0,Ot=ft.length;wt<Ot;wt++)Sn(ft[wt],B,q,j)}function Wi(T,B,q,j){const G=T.opaque,ft=T.transmissive,wt=T.transparent;d.setupLightsView(q),lt===!0&&dt.setGlobalState(v.clippingPlanes,q),j&&Gt.viewport(A.copy(j)),G.length>0&&ks(G,B,q),ft.length>0&&ks(ft,B,q),wt.length>0&&ks(wt,B,q),Gt.buffers.depth.setTest(!0),Gt.buffers.depth.setMask(!0),Gt.buffers.color.setMask(!0),Gt.setPolygonOffset(!1)}function Xi(T,B,q,j){if((q.isScene===!0?q.overrideMaterial:null)!==null)return;d.state.transmissionRenderTarget[j.id]===void 0&&(d.state.transmissionRenderTarget[j.id]=new Ds(1,1,{generateMipmaps:!0,type:Qt.has("EXT_color_buffer_half_float")||Qt.has("EXT_color_buffer_float")?oa:_s,minFilter:cr,samples:4,stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,colorSpace:fe.workingColorSpace}));const ft=d.state.transmissionRenderTarget[j.id],wt=j.viewport||A;ft.setSize(wt.z,wt.w);const Ot=v.getRenderTarget();v.setRenderTarget(ft),v.getClearColor(Y),X=v.getClearAlpha(),X<1&&v.setClearColor(16777215,.5),v.clear(),Kt&&Nt.render(q);const Ft=v.toneMapping;v.toneMapping=Is;const Wt=j.viewport;if(j.viewport!==void 0&&(j.viewport=void 0),d.setupLightsView(j),lt===!0&&dt.setGlobalState(v.clippingPlanes,j),ks(T,q,j),C.updateMultisampleRenderTarget(ft),C.updateRenderTargetMipmap(ft),Qt.has("WEBGL_multisampled_render_to_texture")===!1){let Yt=!1;for(let Dt=0,oe=B.length;Dt<oe;Dt++){const Me=B[Dt],Se=Me.object,pn=Me.geometry,ue=Me.material,Bt=Me.group;if(ue.side===ui&&Se.layers.test(j.layers)){const ze=ue.side;ue.side=Cn,ue.needsUpdate=!0,Po(Se,q,j,pn,ue,Bt),ue.side=ze,ue.needsUpdate=!0,Yt=!0}}Yt===!0&&(C.updateMultisampleRenderTarget(ft),C.updateRenderTargetMipmap(ft))}v.setRenderTarget(Ot),v.setClearColor(Y,X),Wt!==void 0&&(j.viewport=Wt),v.toneMapping=Ft}function ks(T,B,q){const j=B.isScene===!0?B.overrideMaterial:null;for(let G=0,ft=T.length;G<ft;G++){const wt=T[G],Ot=wt.object,Ft=wt.geometry,Wt=j===null?wt.material:j,Yt=wt.group;Ot.layers.test(q.layers)&&Po(Ot,B,q,Ft,Wt,Yt)}}function Po(T,B,q,j,G,ft){T.onBeforeRender(v,B,q,j,G,ft),T.modelViewMatrix.multiplyMatrices(q.matrixWorldInverse,T.matrixWorld),T.normalMatrix.getNormalMatrix(T.modelViewMatrix),G.onBeforeRender(v,B,q,j,T,ft),G.transparent===!0&&G.side===ui&&G.forceSinglePass===!1?(G.side=Cn,G.needsUpdate=!0,v.renderBufferDirect(q,B,j,G,T,ft),G.side=Vi,G.needsUpdate=!0,v.renderBufferDirect(q,B,j,G,T,ft),G.side=ui):v.renderBufferDirect(q,B,j,G,T,ft),T.onAfterRender(v,B,q,j,G,ft)}function Mr(T,B,q){B.isScene!==!0&&(B=ce);const j=Lt.get(T),G=d.state.lights,ft=d.state.shadowsArray,wt=G.state.version,Ot=St.getParameters(T,G.state,ft,B,q),Ft=St.getProgramCacheKey(Ot);let Wt=j.programs;j.environment=T.isMeshStandardMaterial?B.environment:null,j.fog=B.fog,j.envMap=(T.isMeshStandardMaterial?Z:E).get(T.envMap||j.environment),j.envMapRotation=j.environment!==null&&T.envMap===null?B.environmentRotation:T.envMapRotation,Wt===void 0&&(T.addEventListener("dispose",Jt),Wt=new Map,j.programs=Wt);let Yt=Wt.get(Ft);if(Yt!==void 0){if(j.currentProgram===Yt&&j.lightsStateVersion===wt)return Ri(T,Ot),Yt}else Ot.uniforms=St.getUniforms(T),T.onBeforeCompile(Ot,v),Yt=St.acquireProgram(Ot,Ft),Wt.set(Ft,Yt),j.uniforms=Ot.uniforms;const Dt=j.uniforms;return(!T.isShaderMaterial&&!T.isRawShaderMaterial||T.clipping===!0)&&(Dt.clippingPlanes=dt.uniform),Ri(T,Ot),j.needsLights=ua(T),j.lightsStateVersion=wt,j.needsLights&&(Dt.ambientLightColor.value=G.state.ambient,Dt.lightProbe.value=G.state.probe,Dt.directionalLights.value=G.state.directional,Dt.directionalLightShadows.value=G.state.directionalShadow,Dt.spotLights.value=G.state.spot,Dt.spotLightShadows.value=G.state.spotShadow,Dt.rectAreaLights.value=G.state.rectArea,Dt.ltc_1.value=G.state.rectAreaLTC1,Dt.ltc_2.value=G.state.rectAreaLTC2,Dt.pointLights.value=G.state.point,Dt.pointLightShadows.value=G.state.pointShadow,Dt.hemisphereLights.value=G.state.hemi,Dt.directionalShadowMap.value=G.state.directionalShadowMap,Dt.directionalShadowMatrix.value=G.state.directionalShadowMatrix,Dt.spotShadowMap.value=G.state.spotShadowMap,Dt.spotLightMatrix.value=G.state.spotLightMatrix,Dt.spotLightMap.value=G.state.spotLightMap,Dt.pointShadowMap.value=G.state.pointShadowMap,Dt.pointShadowMatrix.value=G.state.pointShadowMatrix),j.currentProgram=Yt,j.uniformsList=null,Yt}function ha(T){if(T.uniformsList===null){const B=T.currentProgram.getUniforms();T.uniformsList=ll.seqWithValue(B.seq,T.uniforms)}return T.uniformsList}function Ri(T,B){const q=Lt.get(T);q.outputColorSpace=B.outputColorSpace,q.batching=B.batching,q.batchingColor=B.batchingColor,q.instancing=B.instancing,q.instancingColor=B.instancingColor,q.instancingMorph=B.instancingMorph,q.skinning=B.skinning,q.morphTargets=B.morphTargets,q.morphNormals=B.morphNormals,q.morphColors=B.morphColors,q.morphTargetsCount=B.morphTargetsCount,q.numClippingPlanes=B.numClippingPlanes,q.numIntersection=B.numClipIntersection,q.vertexAlphas=B.vertexAlphas,q.vertexTangents=B.vertexTangents,q.toneMapping=B.toneMapping}function Jl(T,B,q,j,G){B.isScene!==!0&&(B=ce),C.resetTextureUnits();const ft=B.fog,wt=j.isMeshStandardMaterial?B.environment:null,Ot=F===null?v.outputColorSpace:F.isXRRenderTarget===!0?F.texture.colorSpace:br,Ft=(j.isMeshStandardMaterial?Z:E).get(j.envMap||wt),Wt=j.vertexColors===!0&&!!q.attributes.color&&q.attributes.color.itemSize===4,Yt=!!q.attributes.tangent&&(!!j.normalMap||j.anisotropy>0),Dt=!!q.morphAttributes.position,oe=!!q.morphAttributes.normal,Me=!!q.morphAttributes.color;let Se=Is;j.toneMapped&&(F===null||F.isXRRenderTarget===!0)&&(Se=v.toneMapping);const pn=q.morphAttributes.position||q.morphAttributes.normal||q.morphAttributes.color,ue=pn!==void 0?pn.length:0,Bt=Lt.get(j),ze=d.state.lights;if(lt===!0&&(bt===!0||T!==x)){const In=T===x&&j.id===S;dt.setState(j,T,In)}let me=!1;j.version===Bt.__version?(Bt.needsLights&&Bt.lightsStateVersion!==ze.state.version||Bt.outputColorSpace!==Ot||G.isBatchedMesh&&Bt.batching===!1||!G.isBatchedMesh&&Bt.batching===!0||G.isBatchedMesh&&Bt.batchingColor===!0&&G.colorTexture===null||G.isBatchedMesh&&Bt.batchingColor===!1&&G.colorTexture!==null||G.isInstancedMesh&&Bt.instancing===!1||!G.isInstancedMesh&&Bt.instancing===!0||G.isSkinnedMesh&&Bt.skinning===!1||!G.isSkinnedMesh&&Bt.skinning===!0||G.isInstancedMesh&&Bt.instancingColor===!0&&G.instanceColor===null||G.isInstancedMesh&&Bt.instancingColor===!1&&G.instanceColor!==null||G.isInstancedMesh&&Bt.instancingMorph===!0&&G.morphTexture===null||G.isInstancedMesh&&Bt.instancingMorph===!1&&G.morphTexture!==null||Bt.envMap!==Ft||j.fog===!0&&Bt.fog!==ft||Bt.numClippingPlanes!==void 0&&(Bt.numClippingPlanes!==dt.numPlanes||Bt.numIntersection!==dt.numIntersection)||Bt.vertexAlphas!==Wt||Bt.vertexTangents!==Yt||Bt.morphTargets!==Dt||Bt.morphNormals!==oe||Bt.morphColors!==Me||Bt.toneMapping!==Se||Bt.morphTargetsCount!==ue)&&(me=!0):(me=!0,Bt.__version=j.version);let Hn=Bt.currentProgram;me===!0&&(Hn=Mr(j,B,G));let Pi=!1,wn=!1,zs=!1;const Ce=Hn.getUniforms(),ei=Bt.uniforms;if(Gt.useProgram(Hn.program)&&(Pi=!0,wn=!0,zs=!0),j.id!==S&&(S=j.id,wn=!0),Pi||x!==T){Gt.buffers.depth.getReversed()?(at.copy(T.projectionMatrix),jx(at),$x(at),Ce.setValue(H,"projectionMatrix",at)):Ce.setValue(H,"projectionMatrix",T.projectionMatrix),Ce.setValue(H,"viewMatrix",T.matrixWorldInverse);const Ci=Ce.map.cameraPosition;Ci!==void 0&&Ci.setValue(H,Ht.setFromMatrixPosition(T.matrixWorld)),ee.logarithmicDepthBuffer&&Ce.setValue(H,"logDepthBufFC",2/(Math.log(T.far+1)/Math.LN2)),(j.isMeshPhongMaterial||j.isMeshToonMaterial||j.isMeshLambertMaterial||j.isMeshBasicMaterial||j.isMeshStandardMaterial||j.isShaderMaterial)&&Ce.setValue(H,"isOrthographic",T.isOrthographicCamera===!0),x!==T&&(x=T,wn=!0,zs=!0)}if(G.isSkinnedMesh){Ce.setOptional(H,G,"bindMatrix"),Ce.setOptional(H,G,"bindMatrixInverse");const In=G.skeleton;In&&(In.boneTexture===null&&In.computeBoneTexture(),Ce.setValue(H,"boneTexture",In.boneTexture,C))}G.isBatchedMesh&&(Ce.setOptional(H,G,"batchingTexture"),Ce.setValue(H,"batchingTexture",G._matricesTexture,C),Ce.setOptional(H,G,"batchingIdTexture"),Ce.setValue(H,"batchingIdTexture",G._indirectTexture,C),Ce.setOptional(H,G,"batchingColorTexture"),G._colorsTexture!==null&&Ce.setValue(H,"batchingColorTexture",G._colorsTexture,C));const bs=q.morphAttributes;if((bs.position!==void 0||bs.normal!==void 0||bs.color!==void 0)&&kt.update(G,q,Hn),(wn||Bt.receiveShadow!==G.receiveShadow)&&(Bt.receiveShadow=G.receiveShadow,Ce.setValue(H,"receiveShadow",G.receiveShadow)),j.isMeshGouraudMaterial&&j.envMap!==null&&(ei.envMap.value=Ft,ei.flipEnvMap.value=Ft.isCubeTexture&&Ft.isRenderTargetTexture===!1?-1:1),j.isMeshStandardMaterial&&j.envMap===null&&B.environment!==null&&(ei.envMapIntensity.value=B.environmentIntensity),wn&&(Ce.setValue(H,"toneMappingExposure",v.toneMappingExposure),Bt.needsLights&&Bs(ei,zs),ft&&j.fog===!0&&xt.refreshFogUniforms(ei,ft),xt.refreshMaterialUniforms(ei,j,et,K,d.state.transmissionRenderTarget[T.id]),ll.upload(H,ha(Bt),ei,C)),j.isShaderMaterial&&j.uniformsNeedUpdate===!0&&(ll.upload(H,ha(Bt),ei,C),j.uniformsNeedUpdate=!1),j.isSpriteMaterial&&Ce.setValue(H,"center",G.center),Ce.setValue(H,"modelViewMatrix",G.modelViewMatrix),Ce.setValue(H,"normalMatrix",G.normalMatrix),Ce.setValue(H,"modelMatrix",G.matrixWorld),j.isShaderMaterial||j.isRawShaderMaterial){const In=j.uniformsGroups;for(let Ci=0,di=In.length;Ci<di;Ci++){const yr=In[Ci];z.update(yr,Hn),z.bind(yr,Hn)}}return Hn}function Bs(T,B){T.ambientLightColor.needsUpdate=B,T.lightProbe.needsUpdate=B,T.directionalLights.needsUpdate=B,T.directionalLightShadows.needsUpdate=B,T.pointLights.needsUpdate=B,T.pointLightShadows.needsUpdate=B,T.spotLights.needsUpdate=B,T.spotLightShadows.needsUpdate=B,T.rectAreaLights.needsUpdate=B,T.hemisphereLights.needsUpdate=B}function ua(T){return T.isMeshLambertMaterial||T.isMeshToonMaterial||T.isMeshPhongMaterial||T.isMeshStandardMaterial||T.isShadowMaterial||T.isShaderMaterial&&T.lights===!0}this.getActiveCubeFace=function(){return P},this.getActiveMipmapLevel=function(){return L},this.getRenderTarget=function(){return F},this.setRenderTargetTextures=function(T,B,q){Lt.get(T.texture).__webglTexture=B,Lt.get(T.depthTexture).__webglTexture=q;const j=Lt.get(T);j.__hasExternalTextures=!0,j.__autoAllocateDepthBuffer=q===void 0,j.__autoAllocateDepthBuffer||Qt.has("WEBGL_multisampled_render_to_texture")===!0&&(console.warn("THREE.WebGLRenderer: Render-to-texture extension was disabled because an external texture was provided"),j.__useRenderToTexture=!1)},this.setRenderTargetFramebuffer=function(T,B){const q=Lt.get(T);q.__webglFramebuffer=B,q.__useDefaultFramebuffer=B===void 0},this.setRenderTarget=function(T,B=0,q=0){F=T,P=B,L=q;let j=!0,G=null,ft=!1,wt=!1;if(T){const Ft=Lt.get(T);if(Ft.__useDefaultFramebuffer!==void 0)Gt.bindFramebuffer(H.FRAMEBUFFER,null),j=!1;else if(Ft.__webglFramebuffer===void 0)C.setupRenderTarget(T);else if(Ft.__hasExternalTextures)C.rebindTextures(T,Lt.get(T.texture).__webglTexture,Lt.get(T.depthTexture).__webglTexture);else if(T.depthBuffer){const Dt=T.depthTexture;if(Ft.__boundDepthTexture!==Dt){if(Dt!==null&&Lt.has(Dt)&&(T.width!==Dt.image.width||T.height!==Dt.image.height))throw new Error("WebGLRenderTarget: Attached DepthTexture is initialized to the incorrect size.");C.setupDepthRenderbuffer(T)}}const Wt=T.texture;(Wt.isData3DTexture||Wt.isDataArrayTexture||Wt.isCompressedArrayTexture)&&(wt=!0);const Yt=Lt.get(T).__webglFramebuffer;T.isWebGLCubeRenderTarget?(Array.isArray(Yt[B])?G=Yt[B][q]:G=Yt[B],ft=!0):T.samples>0&&C.useMultisampledRTT(T)===!1?G=Lt.get(T).__webglMultisampledFramebuffer:Array.isArray(Yt)?G=Yt[q]:G=Yt,A.copy(T.viewport),V.copy(T.scissor),N=T.scissorTest}else A.copy(_t).multiplyScalar(et).floor(),V.copy(vt).multiplyScalar(et).floor(),N=pt;if(Gt.bindFramebuffer(H.FRAMEBUFFER,G)&&j&&Gt.drawBuffers(T,G),Gt.viewport(A),Gt.scissor(V),Gt.setScissorTest(N),ft){const Ft=Lt.get(T.texture);H.framebufferTexture2D(H.FRAMEBUFFER,H.COLOR_ATTACHMENT0,H.TEXTURE_CUBE_MAP_POSITIVE_X+B,Ft.__webglTexture,q)}else if(wt){const Ft=Lt.get(T.texture),Wt=B||0;H.framebufferTextureLayer(H.FRAMEBUFFER,H.COLOR_ATTACHMENT0,Ft.__webglTexture,q||0,Wt)}S=-1},this.readRenderTargetPixels=function(T,B,q,j,G,ft,wt){if(!(T&&T.isWebGLRenderTarget)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let Ot=Lt.get(T).__webglFramebuffer;if(T.isWebGLCubeRenderTarget&&wt!==void 0&&(Ot=Ot[wt]),Ot){Gt.bindFramebuffer(H.FRAMEBUFFER,Ot);try{const Ft=T.texture,Wt=Ft.format,Yt=Ft.type;if(!ee.textureFormatReadable(Wt)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(!ee.textureTypeReadable(Yt)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}B>=0&&B<=T.width-j&&q>=0&&q<=T.height-G&&H.readPixels(B,q,j,G,qt.convert(Wt),qt.convert(Yt),ft)}finally{const Ft=F!==null?Lt.get(F).__webglFramebuffer:null;Gt.bindFramebuffer(H.FRAMEBUFFER,Ft)}}},this.readRenderTargetPixelsAsync=async function(T,B,q,j,G,ft,wt){if(!(T&&T.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let Ot=Lt.get(T).__webglFramebuffer;if(T.isWebGLCubeRenderTarget&&wt!==void 0&&(Ot=Ot[wt]),Ot){const Ft=T.texture,Wt=Ft.format,Yt=Ft.type;if(!ee.textureFormatReadable(Wt))throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(!ee.textureTypeReadable(Yt))throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");if(B>=0&&B<=T.width-j&&q>=0&&q<=T.height-G){Gt.bindFramebuffer(H.FRAMEBUFFER,Ot);const Dt=H.createBuffer();H.bindBuffer(H.PIXEL_PACK_BUFFER,Dt),H.bufferData(H.PIXEL_PACK_BUFFER,ft.byteLength,H.STREAM_READ),H.readPixels(B,q,j,G,qt.convert(Wt),qt.convert(Yt),0);const oe=F!==null?Lt.get(F).__webglFramebuffer:null;Gt.bindFramebuffer(H.FRAMEBUFFER,oe);const Me=H.fenceSync(H.SYNC_GPU_COMMANDS_COMPLETE,0);return H.flush(),await qx(H,Me,4),H.bindBuffer(H.PIXEL_PACK_BUFFER,Dt),H.getBufferSubData(H.PIXEL_PACK_BUFFER,0,ft),H.deleteBuffer(Dt),H.deleteSync(Me),ft}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")}},this.copyFramebufferToTexture=function(T,B=null,q=0){T.isTexture!==!0&&($o("WebGLRenderer: copyFramebufferToTexture function signature has changed."),B=arguments[0]||null,T=arguments[1]);const j=Math.pow(2,-q),G=Math.floor(T.image.width*j),ft=Math.floor(T.image.height*j),wt=B!==null?B.x:0,Ot=B!==null?B.y:0;C.setTexture2D(T,0),H.copyTexSubImage2D(H.TEXTURE_2D,q,0,0,wt,Ot,G,ft),Gt.unbindTexture()},this.copyTextureToTexture=function(T,B,q=null,j=null,G=0){T.isTexture!==!0&&($o("WebGLRenderer: copyTextureToTexture function signature has changed."),j=arguments[0]||null,T=arguments[1],B=arguments[2],G=arguments[3]||0,q=null);let ft,wt,Ot,Ft,Wt,Yt,Dt,oe,Me;const Se=T.isCompressedTexture?T.mipmaps[G]:T.image;q!==null?(ft=q.max.x-q.min.x,wt=q.max.y-q.min.y,Ot=q.isBox3?q.max.z-q.min.z:1,Ft=q.min.x,Wt=q.min.y,Yt=q.isBox3?q.min.z:0):(ft=Se.width,wt=Se.height,Ot=Se.depth||1,Ft=0,Wt=0,Yt=0),j!==null?(Dt=j.x,oe=j.y,Me=j.z):(Dt=0,oe=0,Me=0);const pn=qt.convert(B.format),ue=qt.convert(B.type);let Bt;B.isData3DTexture?(C.setTexture3D(B,0),Bt=H.TEXTURE_3D):B.isDataArrayTexture||B.isCompressedArrayTexture?(C.setTexture2DArray(B,0),Bt=H.TEXTURE_2D_ARRAY):(C.setTexture2D(B,0),Bt=H.TEXTURE_2D),H.pixelStorei(H.UNPACK_FLIP_Y_WEBGL,B.flipY),H.pixelStorei(H.UNPACK_PREMULTIPLY_ALPHA_WEBGL,B.premultiplyAlpha),H.pixelStorei(H.UNPACK_ALIGNMENT,B.unpackAlignment);const ze=H.getParameter(H.UNPACK_ROW_LENGTH),me=H.getParameter(H.UNPACK_IMAGE_HEIGHT),Hn=H.getParameter(H.UNPACK_SKIP_PIXELS),Pi=H.getParameter(H.UNPACK_SKIP_ROWS),wn=H.getParameter(H.UNPACK_SKIP_IMAGES);H.pixelStorei(H.UNPACK_ROW_LENGTH,Se.width),H.pixelStorei(H.UNPACK_IMAGE_HEIGHT,Se.height),H.pixelStorei(H.UNPACK_SKIP_PIXELS,Ft),H.pixelStorei(H.UNPACK_SKIP_ROWS,Wt),H.pixelStorei(H.UNPACK_SKIP_IMAGES,Yt);const zs=T.isDataArrayTexture||T.isData3DTexture,Ce=B.isDataArrayTexture||B.isData3DTexture;if(T.isRenderTargetTexture||T.isDepthTexture){const ei=Lt.get(T),bs=Lt.get(B),In=Lt.get(ei.__renderTarget),Ci=Lt.get(bs.__renderTarget);Gt.bindFramebuffer(H.READ_FRAMEBUFFER,In.__webglFramebuffer),Gt.bindFramebuffer(H.DRAW_FRAMEBUFFER,Ci.__webglFramebuffer);for(let di=0;di<Ot;di++)zs&&H.framebufferTextureLayer(H.READ_FRAMEBUFFER,H.COLOR_ATTACHMENT0,Lt.get(T).__webglTexture,G,Yt+di),T.isDepthTexture?(Ce&&H.framebufferTextureLayer(H.DRAW_FRAMEBUFFER,H.COLOR_ATTACHMENT0,Lt.get(B).__webglTexture,G,Me+di),H.blitFramebuffer(Ft,Wt,ft,wt,Dt,oe,ft,wt,H.DEPTH_BUFFER_BIT,H.NEAREST)):Ce?H.copyTexSubImage3D(Bt,G,Dt,oe,Me+di,Ft,Wt,ft,wt):H.copyTexSubImage2D(Bt,G,Dt,oe,Me+di,Ft,Wt,ft,wt);Gt.bindFramebuffer(H.READ_FRAMEBUFFER,null),Gt.bindFramebuffer(H.DRAW_FRAMEBUFFER,null)}else Ce?T.isDataTexture||T.isData3DTexture?H.texSubImage3D(Bt,G,Dt,oe,Me,ft,wt,Ot,pn,ue,Se.data):B.isCompressedArrayTexture?H.compressedTexSubImage3D(Bt,G,Dt,oe,Me,ft,wt,Ot,pn,Se.data):H.texSubImage3D(Bt,G,Dt,oe,Me,ft,wt,Ot,pn,ue,Se):T.isDataTexture?H.texSubImage2D(H.TEXTURE_2D,G,Dt,oe,ft,wt,pn,ue,Se.data):T.isCompressedTexture?H.compressedTexSubImage2D(H.TEXTURE_2D,G,Dt,oe,Se.width,Se.height,pn,Se.data):H.texSubImage2D(H.TEXTURE_2D,G,Dt,oe,ft,wt,pn,ue,Se);H.pixelStorei(H.UNPACK_ROW_LENGTH,ze),H.pixelStorei(H.UNPACK_IMAGE_HEIGHT,me),H.pixelStorei(H.UNPACK_SKIP_PIXELS,Hn),H.pixelStorei(H.UNPACK_SKIP_ROWS,Pi),H.pixelStorei(H.UNPACK_SKIP_IMAGES,wn),G===0&&B.generateMipmaps&&H.generateMipmap(Bt),Gt.unbindTexture()},this.copyTextureToTexture3D=function(T,B,q=null,j=null,G=0){return T.isTexture!==!0&&($o("WebGLRenderer: copyTextureToTexture3D function signature has changed."),q=arguments[0]||null,j=arguments[1]||null,T=arguments[2],B=arguments[3],G=arguments[4]||0),$o('WebGLRenderer: copyTextureToTexture3D function has been deprecated. Use "copyTextureToTexture" instead.'),this.copyTextureToTexture(T,B,q,j,G)},this.initRenderTarget=function(T){Lt.get(T).__webglFramebuffer===void 0&&C.setupRenderTarget(T)},this.initTexture=function(T){T.isCubeTexture?C.setTextureCube(T,0):T.isData3DTexture?C.setTexture3D(T,0):T.isDataArrayTexture||T.isCompressedArrayTexture?C.setTexture2DArray(T,0):C.setTexture2D(T,0),Gt.unbindTexture()},this.resetState=function(){P=0,L=0,F=null,Gt.reset(),pe.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return hs}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;const e=this.getContext();e.drawingBufferColorspace=fe._getDrawingBufferColorSpace(t),e.unpackColorSpace=fe._getUnpackColorSpace()}}class F_ extends Mn{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new gs,this.environmentIntensity=1,this.environmentRotation=new gs,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),t.background!==null&&(this.background=t.background.clone()),t.environment!==null&&(this.environment=t.environment.clone()),t.fog!==null&&(this.fog=t.fog.clone()),this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),t.overrideMaterial!==null&&(this.overrideMaterial=t.overrideMaterial.clone()),this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){const e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),this.backgroundBlurriness>0&&(e.object.backgroundBlurriness=this.backgroundBlurriness),this.backgroundIntensity!==1&&(e.object.backgroundIntensity=this.backgroundIntensity),e.object.backgroundRotation=this.backgroundRotation.toArray(),this.environmentIntensity!==1&&(e.object.environmentIntensity=this.environmentIntensity),e.object.environmentRotation=this.environmentRotation.toArray(),e}}class $u extends zn{constructor(t=null,e=1,n=1,s,r,o,a,l,c=Ln,h=Ln,f,u){super(null,o,a,l,c,h,s,r,f,u),this.isDataTexture=!0,this.image={data:t,width:e,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}}class wp extends Fe{constructor(t,e,n,s=1){super(t,e,n),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=s}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}toJSON(){const t=super.toJSON();return t.meshPerAttribute=this.meshPerAttribute,t.isInstancedBufferAttribute=!0,t}}const jr=new Pe,Ep=new Pe,Ga=[],Tp=new Os,s1=new Pe,Ho=new Ye,Go=new xr;class r1 extends Ye{constructor(t,e,n){super(t,e),this.isInstancedMesh=!0,this.instanceMatrix=new wp(new Float32Array(n*16),16),this.instanceColor=null,this.morphTexture=null,this.count=n,this.boundingBox=null,this.boundingSphere=null;for(let s=0;s<n;s++)this.setMatrixAt(s,s1)}computeBoundingBox(){const t=this.geometry,e=this.count;this.boundingBox===null&&(this.boundingBox=new Os),t.boundingBox===null&&t.computeBoundingBox(),this.boundingBox.makeEmpty();for(let n=0;n<e;n++)this.getMatrixAt(n,jr),Tp.copy(t.boundingBox).applyMatrix4(jr),this.boundingBox.union(Tp)}computeBoundingSphere(){const t=this.geometry,e=this.count;this.boundingSphere===null&&(this.boundingSphere=new xr),t.boundingSphere===null&&t.computeBoundingSphere(),this.boundingSphere.makeEmpty();for(let n=0;n<e;n++)this.getMatrixAt(n,jr),Go.copy(t.boundingSphere).applyMatrix4(jr),this.boundingSphere.union(Go)}copy(t,e){return super.copy(t,e),this.instanceMatrix.copy(t.instanceMatrix),t.morphTexture!==null&&(this.morphTexture=t.morphTexture.clone()),t.instanceColor!==null&&(this.instanceColor=t.instanceColor.clone()),this.count=t.count,t.boundingBox!==null&&(this.boundingBox=t.boundingBox.clone()),t.boundingSphere!==null&&(this.boundingSphere=t.boundingSphere.clone()),this}getColorAt(t,e){e.fromArray(this.instanceColor.array,t*3)}getMatrixAt(t,e){e.fromArray(this.instanceMatrix.array,t*16)}getMorphAt(t,e){const n=e.morphTargetInfluences,s=this.morphTexture.source.data.data,r=n.length+1,o=t*r+1;for(let a=0;a<n.length;a++)n[a]=s[o+a]}raycast(t,e){const n=this.matrixWorld,s=this.count;if(Ho.geometry=this.geometry,Ho.material=this.material,Ho.material!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),Go.copy(this.boundingSphere),Go.applyMatrix4(n),t.ray.intersectsSphere(Go)!==!1))for(let r=0;r<s;r++){this.getMatrixAt(r,jr),Ep.multiplyMatrices(n,jr),Ho.matrixWorld=Ep,Ho.raycast(t,Ga);for(let o=0,a=Ga.length;o<a;o++){const l=Ga[o];l.instanceId=r,l.object=this,e.push(l)}Ga.length=0}}setColorAt(t,e){this.instanceColor===null&&(this.instanceColor=new wp(new Float32Array(this.instanceMatrix.count*3).fill(1),3)),e.toArray(this.instanceColor.array,t*3)}setMatrixAt(t,e){e.toArray(this.instanceMatrix.array,t*16)}setMorphAt(t,e){const n=e.morphTargetInfluences,s=n.length+1;this.morphTexture===null&&(this.morphTexture=new $u(new Float32Array(s*this.count),s,this.count,Hu,Ti));const r=this.morphTexture.source.data.data;let o=0;for(let c=0;c<n.length;c++)o+=n[c];const a=this.geometry.morphTargetsRelative?1:1-o,l=s*t;r[l]=a,r.set(n,l+1)}updateMorphTargets(){}dispose(){return this.dispatchEvent({type:"dispose"}),this.morphTexture!==null&&(this.morphTexture.dispose(),this.morphTexture=null),this}}class Zu extends To{static get type(){return"LineBasicMaterial"}constructor(t){super(),this.isLineBasicMaterial=!0,this.color=new re(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}}const Cl=new D,Ll=new D,Ap=new Pe,Wo=new ql,Wa=new xr,Kc=new D,Rp=new D;class o1 extends Mn{constructor(t=new en,e=new Zu){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){const t=this.geometry;if(t.index===null){const e=t.attributes.position,n=[0];for(let s=1,r=e.count;s<r;s++)Cl.fromBufferAttribute(e,s-1),Ll.fromBufferAttribute(e,s),n[s]=n[s-1],n[s]+=Cl.distanceTo(Ll);t.setAttribute("lineDistance",new tn(n,1))}else console.warn("THREE.Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}raycast(t,e){const n=this.geometry,s=this.matrixWorld,r=t.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Wa.copy(n.boundingSphere),Wa.applyMatrix4(s),Wa.radius+=r,t.ray.intersectsSphere(Wa)===!1)return;Ap.copy(s).invert(),Wo.copy(t.ray).applyMatrix4(Ap);const a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=n.index,u=n.attributes.position;if(h!==null){const p=Math.max(0,o.start),_=Math.min(h.count,o.start+o.count);for(let b=p,m=_-1;b<m;b+=c){const d=h.getX(b),M=h.getX(b+1),w=Xa(this,t,Wo,l,d,M);w&&e.push(w)}if(this.isLineLoop){const b=h.getX(_-1),m=h.getX(p),d=Xa(this,t,Wo,l,b,m);d&&e.push(d)}}else{const p=Math.max(0,o.start),_=Math.min(u.count,o.start+o.count);for(let b=p,m=_-1;b<m;b+=c){const d=Xa(this,t,Wo,l,b,b+1);d&&e.push(d)}if(this.isLineLoop){const b=Xa(this,t,Wo,l,_-1,p);b&&e.push(b)}}}updateMorphTargets(){const e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){const s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){const a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}}function Xa(i,t,e,n,s,r){const o=i.geometry.attributes.position;if(Cl.fromBufferAttribute(o,s),Ll.fromBufferAttribute(o,r),e.distanceSqToSegment(Cl,Ll,Kc,Rp)>n)return;Kc.applyMatrix4(i.matrixWorld);const l=t.ray.origin.distanceTo(Kc);if(!(l<t.near||l>t.far))return{distance:l,point:Rp.clone().applyMatrix4(i.matrixWorld),index:s,face:null,faceIndex:null,barycoord:null,object:i}}const Pp=new D,Cp=new D;class Ku extends o1{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){const t=this.geometry;if(t.index===null){const e=t.attributes.position,n=[];for(let s=0,r=e.count;s<r;s+=2)Pp.fromBufferAttribute(e,s),Cp.fromBufferAttribute(e,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+Pp.distanceTo(Cp);t.setAttribute("lineDistance",new tn(n,1))}else console.warn("THREE.LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}}class a1 extends To{static get type(){return"PointsMaterial"}constructor(t){super(),this.isPointsMaterial=!0,this.color=new re(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.alphaMap=t.alphaMap,this.size=t.size,this.sizeAttenuation=t.sizeAttenuation,this.fog=t.fog,this}}const Lp=new Pe,pu=new ql,Ya=new xr,qa=new D;class l1 extends Mn{constructor(t=new en,e=new a1){super(),this.isPoints=!0,this.type="Points",this.geometry=t,this.material=e,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}raycast(t,e){const n=this.geometry,s=this.matrixWorld,r=t.params.Points.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Ya.copy(n.boundingSphere),Ya.applyMatrix4(s),Ya.radius+=r,t.ray.intersectsSphere(Ya)===!1)return;Lp.copy(s).invert(),pu.copy(t.ray).applyMatrix4(Lp);const a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=n.index,f=n.attributes.position;if(c!==null){const u=Math.max(0,o.start),p=Math.min(c.count,o.start+o.count);for(let _=u,b=p;_<b;_++){const m=c.getX(_);qa.fromBufferAttribute(f,m),Ip(qa,m,l,s,t,e,this)}}else{const u=Math.max(0,o.start),p=Math.min(f.count,o.start+o.count);for(let _=u,b=p;_<b;_++)qa.fromBufferAttribute(f,_),Ip(qa,_,l,s,t,e,this)}}updateMorphTargets(){const e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){const s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){const a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}}function Ip(i,t,e,n,s,r,o){const a=pu.distanceSqToPoint(i);if(a<e){const l=new D;pu.closestPointToPoint(i,l),l.applyMatrix4(n);const c=s.ray.origin.distanceTo(l);if(c<s.near||c>s.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:t,face:null,faceIndex:null,barycoord:null,object:o})}}class ra extends en{constructor(t=1,e=1,n=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:e,height:n,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};const c=this;s=Math.floor(s),r=Math.floor(r);const h=[],f=[],u=[],p=[];let _=0;const b=[],m=n/2;let d=0;M(),o===!1&&(t>0&&w(!0),e>0&&w(!1)),this.setIndex(h),this.setAttribute("position",new tn(f,3)),this.setAttribute("normal",new tn(u,3)),this.setAttribute("uv",new tn(p,2));function M(){const v=new D,U=new D;let P=0;const L=(e-t)/n;for(let F=0;F<=r;F++){const S=[],x=F/r,A=x*(e-t)+t;for(let V=0;V<=s;V++){const N=V/s,Y=N*l+a,X=Math.sin(Y),J=Math.cos(Y);U.x=A*X,U.y=-x*n+m,U.z=A*J,f.push(U.x,U.y,U.z),v.set(X,L,J).normalize(),u.push(v.x,v.y,v.z),p.push(N,1-x),S.push(_++)}b.push(S)}for(let F=0;F<s;F++)for(let S=0;S<r;S++){const x=b[S][F],A=b[S+1][F],V=b[S+1][F+1],N=b[S][F+1];(t>0||S!==0)&&(h.push(x,A,N),P+=3),(e>0||S!==r-1)&&(h.push(A,V,N),P+=3)}c.addGroup(d,P,0),d+=P}function w(v){const U=_,P=new $t,L=new D;let F=0;const S=v===!0?t:e,x=v===!0?1:-1;for(let V=1;V<=s;V++)f.push(0,m*x,0),u.push(0,x,0),p.push(.5,.5),_++;const A=_;for(let V=0;V<=s;V++){const Y=V/s*l+a,X=Math.cos(Y),J=Math.sin(Y);L.x=S*J,L.y=m*x,L.z=S*X,f.push(L.x,L.y,L.z),u.push(0,x,0),P.x=X*.5+.5,P.y=J*.5*x+.5,p.push(P.x,P.y),_++}for(let V=0;V<s;V++){const N=U+V,Y=A+V;v===!0?h.push(Y,Y+1,N):h.push(Y+1,Y,N),F+=3}c.addGroup(d,F,v===!0?1:2),d+=F}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new ra(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}}class Ju extends ra{constructor(t=1,e=1,n=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,t,e,n,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:t,height:e,radialSegments:n,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(t){return new Ju(t.radius,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}}class Qu extends en{constructor(t=[],e=[],n=1,s=0){super(),this.type="PolyhedronGeometry",this.parameters={vertices:t,indices:e,radius:n,detail:s};const r=[],o=[];a(s),c(n),h(),this.setAttribute("position",new tn(r,3)),this.setAttribute("normal",new tn(r.slice(),3)),this.setAttribute("uv",new tn(o,2)),s===0?this.computeVertexNormals():this.normalizeNormals();function a(M){const w=new D,v=new D,U=new D;for(let P=0;P<e.length;P+=3)p(e[P+0],w),p(e[P+1],v),p(e[P+2],U),l(w,v,U,M)}function l(M,w,v,U){const P=U+1,L=[];for(let F=0;F<=P;F++){L[F]=[];const S=M.clone().lerp(v,F/P),x=w.clone().lerp(v,F/P),A=P-F;for(let V=0;V<=A;V++)V===0&&F===P?L[F][V]=S:L[F][V]=S.clone().lerp(x,V/A)}for(let F=0;F<P;F++)for(let S=0;S<2*(P-F)-1;S++){const x=Math.floor(S/2);S%2===0?(u(L[F][x+1]),u(L[F+1][x]),u(L[F][x])):(u(L[F][x+1]),u(L[F+1][x+1]),u(L[F+1][x]))}}function c(M){const w=new D;for(let v=0;v<r.length;v+=3)w.x=r[v+0],w.y=r[v+1],w.z=r[v+2],w.normalize().multiplyScalar(M),r[v+0]=w.x,r[v+1]=w.y,r[v+2]=w.z}function h(){const M=new D;for(let w=0;w<r.length;w+=3){M.x=r[w+0],M.y=r[w+1],M.z=r[w+2];const v=m(M)/2/Math.PI+.5,U=d(M)/Math.PI+.5;o.push(v,1-U)}_(),f()}function f(){for(let M=0;M<o.length;M+=6){const w=o[M+0],v=o[M+2],U=o[M+4],P=Math.max(w,v,U),L=Math.min(w,v,U);P>.9&&L<.1&&(w<.2&&(o[M+0]+=1),v<.2&&(o[M+2]+=1),U<.2&&(o[M+4]+=1))}}function u(M){r.push(M.x,M.y,M.z)}function p(M,w){const v=M*3;w.x=t[v+0],w.y=t[v+1],w.z=t[v+2]}function _(){const M=new D,w=new D,v=new D,U=new D,P=new $t,L=new $t,F=new $t;for(let S=0,x=0;S<r.length;S+=9,x+=6){M.set(r[S+0],r[S+1],r[S+2]),w.set(r[S+3],r[S+4],r[S+5]),v.set(r[S+6],r[S+7],r[S+8]),P.set(o[x+0],o[x+1]),L.set(o[x+2],o[x+3]),F.set(o[x+4],o[x+5]),U.copy(M).add(w).add(v).divideScalar(3);const A=m(U);b(P,x+0,M,A),b(L,x+2,w,A),b(F,x+4,v,A)}}function b(M,w,v,U){U<0&&M.x===1&&(o[w]=M.x-1),v.x===0&&v.z===0&&(o[w]=U/2/Math.PI+.5)}function m(M){return Math.atan2(M.z,-M.x)}function d(M){return Math.atan2(-M.y,Math.sqrt(M.x*M.x+M.z*M.z))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new Qu(t.vertices,t.indices,t.radius,t.details)}}class lo extends Qu{constructor(t=1,e=0){const n=(1+Math.sqrt(5))/2,s=[-1,n,0,1,n,0,-1,-n,0,1,-n,0,0,-1,n,0,1,n,0,-1,-n,0,1,-n,n,0,-1,n,0,1,-n,0,-1,-n,0,1],r=[0,11,5,0,5,1,0,1,7,0,7,10,0,10,11,1,5,9,5,11,4,11,10,2,10,7,6,7,1,8,3,9,4,3,4,2,3,2,6,3,6,8,3,8,9,4,9,5,2,4,11,6,2,10,8,6,7,9,8,1];super(s,r,t,e),this.type="IcosahedronGeometry",this.parameters={radius:t,detail:e}}static fromJSON(t){return new lo(t.radius,t.detail)}}class Zl extends en{constructor(t=1,e=32,n=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:e,heightSegments:n,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},e=Math.max(3,Math.floor(e)),n=Math.max(2,Math.floor(n));const l=Math.min(o+a,Math.PI);let c=0;const h=[],f=new D,u=new D,p=[],_=[],b=[],m=[];for(let d=0;d<=n;d++){const M=[],w=d/n;let v=0;d===0&&o===0?v=.5/e:d===n&&l===Math.PI&&(v=-.5/e);for(let U=0;U<=e;U++){const P=U/e;f.x=-t*Math.cos(s+P*r)*Math.sin(o+w*a),f.y=t*Math.cos(o+w*a),f.z=t*Math.sin(s+P*r)*Math.sin(o+w*a),_.push(f.x,f.y,f.z),u.copy(f).normalize(),b.push(u.x,u.y,u.z),m.push(P+v,1-w),M.push(c++)}h.push(M)}for(let d=0;d<n;d++)for(let M=0;M<e;M++){const w=h[d][M+1],v=h[d][M],U=h[d+1][M],P=h[d+1][M+1];(d!==0||o>0)&&p.push(w,v,P),(d!==n-1||l<Math.PI)&&p.push(v,U,P)}this.setIndex(p),this.setAttribute("position",new tn(_,3)),this.setAttribute("normal",new tn(b,3)),this.setAttribute("uv",new tn(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new Zl(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}}class Kl extends Hi{static get type(){return"RawShaderMaterial"}constructor(t){super(t),this.isRawShaderMaterial=!0}}class D_ extends Mn{constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new re(t),this.intensity=e}dispose(){}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){const e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,this.groundColor!==void 0&&(e.object.groundColor=this.groundColor.getHex()),this.distance!==void 0&&(e.object.distance=this.distance),this.angle!==void 0&&(e.object.angle=this.angle),this.decay!==void 0&&(e.object.decay=this.decay),this.penumbra!==void 0&&(e.object.penumbra=this.penumbra),this.shadow!==void 0&&(e.object.shadow=this.shadow.toJSON()),this.target!==void 0&&(e.object.target=this.target.uuid),e}}const Jc=new Pe,Fp=new D,Dp=new D;class c1{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new $t(512,512),this.map=null,this.mapPass=null,this.matrix=new Pe,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new qu,this._frameExtents=new $t(1,1),this._viewportCount=1,this._viewports=[new He(0,0,1,1)]}getViewportCount(){return this._viewportCount}getFrustum(){return this._frustum}updateMatrices(t){const e=this.camera,n=this.matrix;Fp.setFromMatrixPosition(t.matrixWorld),e.position.copy(Fp),Dp.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(Dp),e.updateMatrixWorld(),Jc.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),this._frustum.setFromProjectionMatrix(Jc),n.set(.5,0,0,.5,0,.5,0,.5,0,0,.5,.5,0,0,0,1),n.multiply(Jc)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.mapSize.copy(t.mapSize),this}clone(){return new this.constructor().copy(this)}toJSON(){const t={};return this.intensity!==1&&(t.intensity=this.intensity),this.bias!==0&&(t.bias=this.bias),this.normalBias!==0&&(t.normalBias=this.normalBias),this.radius!==1&&(t.radius=this.radius),(this.mapSize.x!==512||this.mapSize.y!==512)&&(t.mapSize=this.mapSize.toArray()),t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}}class h1 extends c1{constructor(){super(new A_(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}}class u1 extends D_{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(Mn.DEFAULT_UP),this.updateMatrix(),this.target=new Mn,this.shadow=new h1}dispose(){this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}}class f1 extends D_{constructor(t,e){super(t,e),this.isAmbientLight=!0,this.type="AmbientLight"}}class mu{constructor(t=1,e=0,n=0){return this.radius=t,this.phi=e,this.theta=n,this}set(t,e,n){return this.radius=t,this.phi=e,this.theta=n,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=Math.max(1e-6,Math.min(Math.PI-1e-6,this.phi)),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,n){return this.radius=Math.sqrt(t*t+e*e+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,n),this.phi=Math.acos(Rn(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}}const Up=new D,ja=new D;class d1{constructor(t=new D,e=new D){this.start=t,this.end=e}set(t,e){return this.start.copy(t),this.end.copy(e),this}copy(t){return this.start.copy(t.start),this.end.copy(t.end),this}getCenter(t){return t.addVectors(this.start,this.end).multiplyScalar(.5)}delta(t){return t.subVectors(this.end,this.start)}distanceSq(){return this.start.distanceToSquared(this.end)}distance(){return this.start.distanceTo(this.end)}at(t,e){return this.delta(e).multiplyScalar(t).add(this.start)}closestPointToPointParameter(t,e){Up.subVectors(t,this.start),ja.subVectors(this.end,this.start);const n=ja.dot(ja);let r=ja.dot(Up)/n;return e&&(r=Rn(r,0,1)),r}closestPointToPoint(t,e,n){const s=this.closestPointToPointParameter(t,e);return this.delta(n).multiplyScalar(s).add(this.start)}applyMatrix4(t){return this.start.applyMatrix4(t),this.end.applyMatrix4(t),this}equals(t){return t.start.equals(this.start)&&t.end.equals(this.end)}clone(){return new this.constructor().copy(this)}}class p1 extends vr{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(){}disconnect(){}dispose(){}update(){}}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:Ou}}));typeof window<"u"&&(window.__THREE__?console.warn("WARNING: Multiple instances of Three.js being imported."):window.__THREE__=Ou);const Np={type:"change"},tf={type:"start"},U_={type:"end"},$a=new ql,Op=new cs,m1=Math.cos(70*Xx.DEG2RAD),rn=new D,Wn=2*Math.PI,Re={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},Qc=1e-6;class _1 extends p1{constructor(t,e=null){super(t,e),this.state=Re.NONE,this.enabled=!0,this.target=new D,this.cursor=new D,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:so.ROTATE,MIDDLE:so.DOLLY,RIGHT:so.PAN},this.touches={ONE:eo.ROTATE,TWO:eo.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._domElementKeyEvents=null,this._lastPosition=new D,this._lastQuaternion=new Us,this._lastTargetPosition=new D,this._quat=new Us().setFromUnitVectors(t.up,new D(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new mu,this._sphericalDelta=new mu,this._scale=1,this._panOffset=new D,this._rotateStart=new $t,this._rotateEnd=new $t,this._rotateDelta=new $t,this._panStart=new $t,this._panEnd=new $t,this._panDelta=new $t,this._dollyStart=new $t,this._dollyEnd=new $t,this._dollyDelta=new $t,this._dollyDirection=new D,this._mouse=new $t,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=b1.bind(this),this._onPointerDown=g1.bind(this),this._onPointerUp=v1.bind(this),this._onContextMenu=T1.bind(this),this._onMouseWheel=y1.bind(this),this._onKeyDown=S1.bind(this),this._onTouchStart=w1.bind(this),this._onTouchMove=E1.bind(this),this._onMouseDown=x1.bind(this),this._onMouseMove=M1.bind(this),this._interceptControlDown=A1.bind(this),this._interceptControlUp=R1.bind(this),this.domElement!==null&&this.connect(),this.update()}connect(){this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.getRootNode().addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.removeEventListener("pointermove",this._onPointerMove),this.domElement.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.getRootNode().removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.style.touchAction="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(Np),this.update(),this.state=Re.NONE}update(t=null){const e=this.object.position;rn.copy(e).sub(this.target),rn.applyQuaternion(this._quat),this._spherical.setFromVector3(rn),this.autoRotate&&this.state===Re.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let n=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(n)&&isFinite(s)&&(n<-Math.PI?n+=Wn:n>Math.PI&&(n-=Wn),s<-Math.PI?s+=Wn:s>Math.PI&&(s-=Wn),n<=s?this._spherical.theta=Math.max(n,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(n+s)/2?Math.max(n,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{const o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(rn.setFromSpherical(this._spherical),rn.applyQuaternion(this._quatInverse),e.copy(this.target).add(rn),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){const a=rn.length();o=this._clampDistance(a*this._scale);const l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){const a=new D(this._mouse.x,this._mouse.y,0);a.unproject(this.object);const l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;const c=new D(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=rn.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):($a.origin.copy(this.object.position),$a.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot($a.direction))<m1?this.object.lookAt(this.target):(Op.setFromNormalAndCoplanarPoint(this.object.up,this.target),$a.intersectPlane(Op,this.target))))}else if(this.object.isOrthographicCamera){const o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>Qc||8*(1-this._lastQuaternion.dot(this.object.quaternion))>Qc||this._lastTargetPosition.distanceToSquared(this.target)>Qc?(this.dispatchEvent(Np),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?Wn/60*this.autoRotateSpeed*t:Wn/60/60*this.autoRotateSpeed}_getZoomScale(t){const e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){rn.setFromMatrixColumn(e,0),rn.multiplyScalar(-t),this._panOffset.add(rn)}_panUp(t,e){this.screenSpacePanning===!0?rn.setFromMatrixColumn(e,1):(rn.setFromMatrixColumn(e,0),rn.crossVectors(this.object.up,rn)),rn.multiplyScalar(t),this._panOffset.add(rn)}_pan(t,e){const n=this.domElement;if(this.object.isPerspectiveCamera){const s=this.object.position;rn.copy(s).sub(this.target);let r=rn.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/n.clientHeight,this.object.matrix),this._panUp(2*e*r/n.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/n.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/n.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;const n=this.domElement.getBoundingClientRect(),s=t-n.left,r=e-n.top,o=n.width,a=n.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientX),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);const e=this.domElement;this._rotateLeft(Wn*this._rotateDelta.x/e.clientHeight),this._rotateUp(Wn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateUp(Wn*this.rotateSpeed/this.domElement.clientHeight):this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateUp(-Wn*this.rotateSpeed/this.domElement.clientHeight):this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateLeft(Wn*this.rotateSpeed/this.domElement.clientHeight):this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateLeft(-Wn*this.rotateSpeed/this.domElement.clientHeight):this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{const e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._rotateStart.set(n,s)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{const e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panStart.set(n,s)}}_handleTouchStartDolly(t){const e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{const n=this._getSecondPointerPosition(t),s=.5*(t.pageX+n.x),r=.5*(t.pageY+n.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);const e=this.domElement;this._rotateLeft(Wn*this._rotateDelta.x/e.clientHeight),this._rotateUp(Wn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{const e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panEnd.set(n,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){const e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);const o=(t.pageX+e.x)*.5,a=(t.pageY+e.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new $t,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){const e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){const e=t.deltaMode,n={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:n.deltaY*=16;break;case 2:n.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(n.deltaY*=10),n}}function g1(i){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(i.pointerId),this.domElement.addEventListener("pointermove",this._onPointerMove),this.domElement.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(i)&&(this._addPointer(i),i.pointerType==="touch"?this._onTouchStart(i):this._onMouseDown(i)))}function b1(i){this.enabled!==!1&&(i.pointerType==="touch"?this._onTouchMove(i):this._onMouseMove(i))}function v1(i){switch(this._removePointer(i),this._pointers.length){case 0:this.domElement.releasePointerCapture(i.pointerId),this.domElement.removeEventListener("pointermove",this._onPointerMove),this.domElement.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(U_),this.state=Re.NONE;break;case 1:const t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function x1(i){let t;switch(i.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case so.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(i),this.state=Re.DOLLY;break;case so.ROTATE:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=Re.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=Re.ROTATE}break;case so.PAN:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=Re.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=Re.PAN}break;default:this.state=Re.NONE}this.state!==Re.NONE&&this.dispatchEvent(tf)}function M1(i){switch(this.state){case Re.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(i);break;case Re.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(i);break;case Re.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(i);break}}function y1(i){this.enabled===!1||this.enableZoom===!1||this.state!==Re.NONE||(i.preventDefault(),this.dispatchEvent(tf),this._handleMouseWheel(this._customWheelEvent(i)),this.dispatchEvent(U_))}function S1(i){this.enabled===!1||this.enablePan===!1||this._handleKeyDown(i)}function w1(i){switch(this._trackPointer(i),this._pointers.length){case 1:switch(this.touches.ONE){case eo.ROTATE:if(this.enableRotate===!1)return;this._handleTouchStartRotate(i),this.state=Re.TOUCH_ROTATE;break;case eo.PAN:if(this.enablePan===!1)return;this._handleTouchStartPan(i),this.state=Re.TOUCH_PAN;break;default:this.state=Re.NONE}break;case 2:switch(this.touches.TWO){case eo.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(i),this.state=Re.TOUCH_DOLLY_PAN;break;case eo.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(i),this.state=Re.TOUCH_DOLLY_ROTATE;break;default:this.state=Re.NONE}break;default:this.state=Re.NONE}this.state!==Re.NONE&&this.dispatchEvent(tf)}function E1(i){switch(this._trackPointer(i),this.state){case Re.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(i),this.update();break;case Re.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(i),this.update();break;case Re.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(i),this.update();break;case Re.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(i),this.update();break;default:this.state=Re.NONE}}function T1(i){this.enabled!==!1&&i.preventDefault()}function A1(i){i.key==="Control"&&(this._controlActive=!0,this.domElement.getRootNode().addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function R1(i){i.key==="Control"&&(this._controlActive=!1,this.domElement.getRootNode().removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}const kp=["side","oblique","behind","above","tip"],th=350,P1=.75,C1=.3,L1=1.1,I1=.8,F1=1.2;function Bp(i){const t=new Os,e=new D;for(let l=0;l<i.rest.length;l+=3)t.expandByPoint(e.fromArray(i.rest,l));const n=Array.from({length:8},(l,c)=>new D(c&1?t.max.x:t.min.x,c&2?t.max.y:t.min.y,c&4?t.max.z:t.min.z)),s=i.needles[0],r=s?new D(s.direction.x,s.direction.y,s.direction.z).normalize():new D(1,0,0),o=s?{entry:new D(s.entry.x,s.entry.y,s.entry.z),length:s.length}:null,a=Math.abs(r.y)<.9?new D(0,1,0):new D(0,0,1);return{points:n,shaft:o,size:Math.max(t.getSize(e).length()/2,.01),direction:r,up:a}}function D1(i,t,e,n){const s=new D().crossVectors(e,t).normalize(),r=new D().crossVectors(t,s),o=[s,r,t].map(_=>{const b=i.map(m=>m.dot(_));return[Math.min(...b),Math.max(...b)]}),[a,l]=[_=>(_[0]+_[1])/2,_=>(_[1]-_[0])/2],c=new D;[s,r,t].forEach((_,b)=>c.addScaledVector(_,a(o[b])));const h=Math.tan(n.fov*Math.PI/360),f=l(o[0])/(h*n.aspect),u=l(o[1])/(h*I1),p=L1*Math.max(f,u)+l(o[2]);return{target:c,position:c.clone().addScaledVector(t,p)}}class U1{constructor(t,e,n){this.still=e,this.camera=new hi(30,1,.002,5),this.aim=null,this.goal=null,this.from={position:new D,target:new D},this.controls=new _1(this.camera,t),this.controls.minDistance=.02,this.controls.maxDistance=3,this.controls.addEventListener("change",n),this.controls.addEventListener("start",()=>this.goal=null)}setScene(t){this.aim=t,this.camera.up.copy(t.up),this.look("side",null,!0)}look(t,e,n=this.still()){if(this.aim===null)return;const{points:s,shaft:r,size:o,direction:a,up:l}=this.aim,c=new D().crossVectors(a,l).normalize(),f={side:c.clone().addScaledVector(l,.12),oblique:c.clone().addScaledVector(a,-.7).addScaledVector(l,.5),behind:a.clone().negate().addScaledVector(l,.3).addScaledVector(c,.12),above:l.clone().addScaledVector(c,.02),tip:c.clone().addScaledVector(l,.25)}[t].normalize(),u=this.camera.aspect<1?C1:P1,p=r?[...s,r.entry.clone().addScaledVector(a,-u*r.length)]:s;let{position:_,target:b}=D1(p,f,l,this.camera);t==="tip"&&e&&(b=new D(e.x,e.y,e.z),_=b.clone().addScaledVector(f,F1*o)),this.from.position.copy(this.camera.position),this.from.target.copy(this.controls.target),this.goal={position:_,target:b,began:n?-th:performance.now()},this.move(n?th:performance.now())}nudge(t,e,n){this.goal=null;const s=new Us().setFromUnitVectors(this.camera.up,new D(0,1,0)),r=this.camera.position.clone().sub(this.controls.target).applyQuaternion(s),o=new mu().setFromVector3(r);o.theta-=t*Math.PI/180,o.phi=Math.min(Math.PI-.05,Math.max(.05,o.phi-e*Math.PI/180)),o.radius*=n,r.setFromSpherical(o).applyQuaternion(s.invert()),this.camera.position.copy(this.controls.target).add(r),this.controls.update()}move(t){if(this.goal===null)return!1;const e=Math.min(1,(t-this.goal.began)/th),n=e*e*(3-2*e);return this.camera.position.lerpVectors(this.from.position,this.goal.position,n),this.controls.target.lerpVectors(this.from.target,this.goal.target,n),this.controls.update(),e===1&&(this.goal=null),this.goal!==null}}const cl=0,N1=1,O1=new D,zp=new d1,eh=new cs,Vp=new D,Za=new fi;class k1{constructor(){this.tolerance=-1,this.faces=[],this.newFaces=[],this.assigned=new Hp,this.unassigned=new Hp,this.vertices=[]}setFromPoints(t){if(t.length>=4){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.vertices.push(new B1(t[e]));this.compute()}return this}setFromObject(t){const e=[];return t.updateMatrixWorld(!0),t.traverse(function(n){const s=n.geometry;if(s!==void 0){const r=s.attributes.position;if(r!==void 0)for(let o=0,a=r.count;o<a;o++){const l=new D;l.fromBufferAttribute(r,o).applyMatrix4(n.matrixWorld),e.push(l)}}}),this.setFromPoints(e)}containsPoint(t){const e=this.faces;for(let n=0,s=e.length;n<s;n++)if(e[n].distanceToPoint(t)>this.tolerance)return!1;return!0}intersectRay(t,e){const n=this.faces;let s=-1/0,r=1/0;for(let o=0,a=n.length;o<a;o++){const l=n[o],c=l.distanceToPoint(t.origin),h=l.normal.dot(t.direction);if(c>0&&h>=0)return null;const f=h!==0?-c/h:0;if(!(f<=0)&&(h>0?r=Math.min(f,r):s=Math.max(f,s),s>r))return null}return s!==-1/0?t.at(s,e):t.at(r,e),e}intersectsRay(t){return this.intersectRay(t,O1)!==null}makeEmpty(){return this.faces=[],this.vertices=[],this}addVertexToFace(t,e){return t.face=e,e.outside===null?this.assigned.append(t):this.assigned.insertBefore(e.outside,t),e.outside=t,this}removeVertexFromFace(t,e){return t===e.outside&&(t.next!==null&&t.next.face===e?e.outside=t.next:e.outside=null),this.assigned.remove(t),this}removeAllVerticesFromFace(t){if(t.outside!==null){const e=t.outside;let n=t.outside;for(;n.next!==null&&n.next.face===t;)n=n.next;return this.assigned.removeSubList(e,n),e.prev=n.next=null,t.outside=null,e}}deleteFaceVertices(t,e){const n=this.removeAllVerticesFromFace(t);if(n!==void 0)if(e===void 0)this.unassigned.appendChain(n);else{let s=n;do{const r=s.next;e.distanceToPoint(s.point)>this.tolerance?this.addVertexToFace(s,e):this.unassigned.append(s),s=r}while(s!==null)}return this}resolveUnassignedPoints(t){if(this.unassigned.isEmpty()===!1){let e=this.unassigned.first();do{const n=e.next;let s=this.tolerance,r=null;for(let o=0;o<t.length;o++){const a=t[o];if(a.mark===cl){const l=a.distanceToPoint(e.point);if(l>s&&(s=l,r=a),s>1e3*this.tolerance)break}}r!==null&&this.addVertexToFace(e,r),e=n}while(e!==null)}return this}computeExtremes(){const t=new D,e=new D,n=[],s=[];for(let r=0;r<3;r++)n[r]=s[r]=this.vertices[0];t.copy(this.vertices[0].point),e.copy(this.vertices[0].point);for(let r=0,o=this.vertices.length;r<o;r++){const a=this.vertices[r],l=a.point;for(let c=0;c<3;c++)l.getComponent(c)<t.getComponent(c)&&(t.setComponent(c,l.getComponent(c)),n[c]=a);for(let c=0;c<3;c++)l.getComponent(c)>e.getComponent(c)&&(e.setComponent(c,l.getComponent(c)),s[c]=a)}return this.tolerance=3*Number.EPSILON*(Math.max(Math.abs(t.x),Math.abs(e.x))+Math.max(Math.abs(t.y),Math.abs(e.y))+Math.max(Math.abs(t.z),Math.abs(e.z))),{min:n,max:s}}computeInitialHull(){const t=this.vertices,e=this.computeExtremes(),n=e.min,s=e.max;let r=0,o=0;for(let u=0;u<3;u++){const p=s[u].point.getComponent(u)-n[u].point.getComponent(u);p>r&&(r=p,o=u)}const a=n[o],l=s[o];let c,h;r=0,zp.set(a.point,l.point);for(let u=0,p=this.vertices.length;u<p;u++){const _=t[u];if(_!==a&&_!==l){zp.closestPointToPoint(_.point,!0,Vp);const b=Vp.distanceToSquared(_.point);b>r&&(r=b,c=_)}}r=-1,eh.setFromCoplanarPoints(a.point,l.point,c.point);for(let u=0,p=this.vertices.length;u<p;u++){const _=t[u];if(_!==a&&_!==l&&_!==c){const b=Math.abs(eh.distanceToPoint(_.point));b>r&&(r=b,h=_)}}const f=[];if(eh.distanceToPoint(h.point)<0){f.push(Mi.create(a,l,c),Mi.create(h,l,a),Mi.create(h,c,l),Mi.create(h,a,c));for(let u=0;u<3;u++){const p=(u+1)%3;f[u+1].getEdge(2).setTwin(f[0].getEdge(p)),f[u+1].getEdge(1).setTwin(f[p+1].getEdge(0))}}else{f.push(Mi.create(a,c,l),Mi.create(h,a,l),Mi.create(h,l,c),Mi.create(h,c,a));for(let u=0;u<3;u++){const p=(u+1)%3;f[u+1].getEdge(2).setTwin(f[0].getEdge((3-u)%3)),f[u+1].getEdge(0).setTwin(f[p+1].getEdge(1))}}for(let u=0;u<4;u++)this.faces.push(f[u]);for(let u=0,p=t.length;u<p;u++){const _=t[u];if(_!==a&&_!==l&&_!==c&&_!==h){r=this.tolerance;let b=null;for(let m=0;m<4;m++){const d=this.faces[m].distanceToPoint(_.point);d>r&&(r=d,b=this.faces[m])}b!==null&&this.addVertexToFace(_,b)}}return this}reindexFaces(){const t=[];for(let e=0;e<this.faces.length;e++){const n=this.faces[e];n.mark===cl&&t.push(n)}return this.faces=t,this}nextVertexToAdd(){if(this.assigned.isEmpty()===!1){let t,e=0;const n=this.assigned.first().face;let s=n.outside;do{const r=n.distanceToPoint(s.point);r>e&&(e=r,t=s),s=s.next}while(s!==null&&s.face===n);return t}}computeHorizon(t,e,n,s){this.deleteFaceVertices(n),n.mark=N1;let r;e===null?r=e=n.getEdge(0):r=e.next;do{const o=r.twin,a=o.face;a.mark===cl&&(a.distanceToPoint(t)>this.tolerance?this.computeHorizon(t,o,a,s):s.push(r)),r=r.next}while(r!==e);return this}addAdjoiningFace(t,e){const n=Mi.create(t,e.tail(),e.head());return this.faces.push(n),n.getEdge(-1).setTwin(e.twin),n.getEdge(0)}addNewFaces(t,e){this.newFaces=[];let n=null,s=null;for(let r=0;r<e.length;r++){const o=e[r],a=this.addAdjoiningFace(t,o);n===null?n=a:a.next.setTwin(s),this.newFaces.push(a.face),s=a}return n.next.setTwin(s),this}addVertexToHull(t){const e=[];return this.unassigned.clear(),this.removeVertexFromFace(t,t.face),this.computeHorizon(t.point,null,t.face,e),this.addNewFaces(t,e),this.resolveUnassignedPoints(this.newFaces),this}cleanup(){return this.assigned.clear(),this.unassigned.clear(),this.newFaces=[],this}compute(){let t;for(this.computeInitialHull();(t=this.nextVertexToAdd())!==void 0;)this.addVertexToHull(t);return this.reindexFaces(),this.cleanup(),this}}class Mi{constructor(){this.normal=new D,this.midpoint=new D,this.area=0,this.constant=0,this.outside=null,this.mark=cl,this.edge=null}static create(t,e,n){const s=new Mi,r=new nh(t,s),o=new nh(e,s),a=new nh(n,s);return r.next=a.prev=o,o.next=r.prev=a,a.next=o.prev=r,s.edge=r,s.compute()}getEdge(t){let e=this.edge;for(;t>0;)e=e.next,t--;for(;t<0;)e=e.prev,t++;return e}compute(){const t=this.edge.tail(),e=this.edge.head(),n=this.edge.next.head();return Za.set(t.point,e.point,n.point),Za.getNormal(this.normal),Za.getMidpoint(this.midpoint),this.area=Za.getArea(),this.constant=this.normal.dot(this.midpoint),this}distanceToPoint(t){return this.normal.dot(t)-this.constant}}class nh{constructor(t,e){this.vertex=t,this.prev=null,this.next=null,this.twin=null,this.face=e}head(){return this.vertex}tail(){return this.prev?this.prev.vertex:null}length(){const t=this.head(),e=this.tail();return e!==null?e.point.distanceTo(t.point):-1}lengthSquared(){const t=this.head(),e=this.tail();return e!==null?e.point.distanceToSquared(t.point):-1}setTwin(t){return this.twin=t,t.twin=this,this}}class B1{constructor(t){this.point=t,this.prev=null,this.next=null,this.face=null}}class Hp{constructor(){this.head=null,this.tail=null}first(){return this.head}last(){return this.tail}clear(){return this.head=this.tail=null,this}insertBefore(t,e){return e.prev=t.prev,e.next=t,e.prev===null?this.head=e:e.prev.next=e,t.prev=e,this}insertAfter(t,e){return e.prev=t,e.next=t.next,e.next===null?this.tail=e:e.next.prev=e,t.next=e,this}append(t){return this.head===null?this.head=t:this.tail.next=t,t.prev=this.tail,t.next=null,this.tail=t,this}appendChain(t){for(this.head===null?this.head=t:this.tail.next=t,t.prev=this.tail;t.next!==null;)t=t.next;return this.tail=t,this}remove(t){return t.prev===null?this.head=t.next:t.prev.next=t.next,t.next===null?this.tail=t.prev:t.next.prev=t.prev,this}removeSubList(t,e){return t.prev===null?this.head=e.next:t.prev.next=e.next,e.next===null?this.tail=t.prev:e.next.prev=t.prev,this}isEmpty(){return this.head===null}}class z1 extends en{constructor(t=[]){super();const e=[],n=[],r=new k1().setFromPoints(t).faces;for(let o=0;o<r.length;o++){const a=r[o];let l=a.edge;do{const c=l.head().point;e.push(c.x,c.y,c.z),n.push(a.normal.x,a.normal.y,a.normal.z),l=l.next}while(l!==a.edge)}this.setAttribute("position",new tn(e,3)),this.setAttribute("normal",new tn(n,3))}}const V1={uniforms:Xu.merge([gt.common,gt.specularmap,gt.envmap,gt.aomap,gt.lightmap,gt.emissivemap,gt.fog,gt.lights,{emissive:{value:new re(0)}}]),vertexShader:`

		#define GOURAUD

		varying vec3 vLightFront;
		varying vec3 vIndirectFront;

		#ifdef DOUBLE_SIDED
			varying vec3 vLightBack;
			varying vec3 vIndirectBack;
		#endif

		#include <common>
		#include <uv_pars_vertex>
		#include <envmap_pars_vertex>
		#include <bsdfs>
		#include <lights_pars_begin>
		#include <color_pars_vertex>
		#include <fog_pars_vertex>
		#include <morphtarget_pars_vertex>
		#include <skinning_pars_vertex>
		#include <shadowmap_pars_vertex>
		#include <logdepthbuf_pars_vertex>
		#include <clipping_planes_pars_vertex>

		void main() {

			#include <uv_vertex>
			#include <color_vertex>
			#include <morphcolor_vertex>

			#include <beginnormal_vertex>
			#include <morphnormal_vertex>
			#include <skinbase_vertex>
			#include <skinnormal_vertex>
			#include <defaultnormal_vertex>

			#include <begin_vertex>
			#include <morphtarget_vertex>
			#include <skinning_vertex>
			#include <project_vertex>
			#include <logdepthbuf_vertex>
			#include <clipping_planes_vertex>

			#include <worldpos_vertex>
			#include <envmap_vertex>

			// inlining legacy <lights_lambert_vertex>

			vec3 diffuse = vec3( 1.0 );

			vec3 geometryPosition = mvPosition.xyz;
			vec3 geometryNormal = normalize( transformedNormal );
			vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( -mvPosition.xyz );

			vec3 backGeometryNormal = - geometryNormal;

			vLightFront = vec3( 0.0 );
			vIndirectFront = vec3( 0.0 );
			#ifdef DOUBLE_SIDED
				vLightBack = vec3( 0.0 );
				vIndirectBack = vec3( 0.0 );
			#endif

			IncidentLight directLight;
			float dotNL;
			vec3 directLightColor_Diffuse;

			vIndirectFront += getAmbientLightIrradiance( ambientLightColor );

			#if defined( USE_LIGHT_PROBES )

				vIndirectFront += getLightProbeIrradiance( lightProbe, geometryNormal );

			#endif

			#ifdef DOUBLE_SIDED

				vIndirectBack += getAmbientLightIrradiance( ambientLightColor );

				#if defined( USE_LIGHT_PROBES )

					vIndirectBack += getLightProbeIrradiance( lightProbe, backGeometryNormal );

				#endif

			#endif

			#if NUM_POINT_LIGHTS > 0

				#pragma unroll_loop_start
				for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {

					getPointLightInfo( pointLights[ i ], geometryPosition, directLight );

					dotNL = dot( geometryNormal, directLight.direction );
					directLightColor_Diffuse = directLight.color;

					vLightFront += saturate( dotNL ) * directLightColor_Diffuse;

					#ifdef DOUBLE_SIDED

						vLightBack += saturate( - dotNL ) * directLightColor_Diffuse;

					#endif

				}
				#pragma unroll_loop_end

			#endif

			#if NUM_SPOT_LIGHTS > 0

				#pragma unroll_loop_start
				for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {

					getSpotLightInfo( spotLights[ i ], geometryPosition, directLight );

					dotNL = dot( geometryNormal, directLight.direction );
					directLightColor_Diffuse = directLight.color;

					vLightFront += saturate( dotNL ) * directLightColor_Diffuse;

					#ifdef DOUBLE_SIDED

						vLightBack += saturate( - dotNL ) * directLightColor_Diffuse;

					#endif
				}
				#pragma unroll_loop_end

			#endif

			#if NUM_DIR_LIGHTS > 0

				#pragma unroll_loop_start
				for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {

					getDirectionalLightInfo( directionalLights[ i ], directLight );

					dotNL = dot( geometryNormal, directLight.direction );
					directLightColor_Diffuse = directLight.color;

					vLightFront += saturate( dotNL ) * directLightColor_Diffuse;

					#ifdef DOUBLE_SIDED

						vLightBack += saturate( - dotNL ) * directLightColor_Diffuse;

					#endif

				}
				#pragma unroll_loop_end

			#endif

			#if NUM_HEMI_LIGHTS > 0

				#pragma unroll_loop_start
				for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {

					vIndirectFront += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );

					#ifdef DOUBLE_SIDED

						vIndirectBack += getHemisphereLightIrradiance( hemisphereLights[ i ], backGeometryNormal );

					#endif

				}
				#pragma unroll_loop_end

			#endif

			#include <shadowmap_vertex>
			#include <fog_vertex>

		}`,fragmentShader:`

		#define GOURAUD

		uniform vec3 diffuse;
		uniform vec3 emissive;
		uniform float opacity;

		varying vec3 vLightFront;
		varying vec3 vIndirectFront;

		#ifdef DOUBLE_SIDED
			varying vec3 vLightBack;
			varying vec3 vIndirectBack;
		#endif

		#include <common>
		#include <packing>
		#include <dithering_pars_fragment>
		#include <color_pars_fragment>
		#include <uv_pars_fragment>
		#include <map_pars_fragment>
		#include <alphamap_pars_fragment>
		#include <alphatest_pars_fragment>
		#include <aomap_pars_fragment>
		#include <lightmap_pars_fragment>
		#include <emissivemap_pars_fragment>
		#include <envmap_common_pars_fragment>
		#include <envmap_pars_fragment>
		#include <bsdfs>
		#include <lights_pars_begin>
		#include <fog_pars_fragment>
		#include <shadowmap_pars_fragment>
		#include <shadowmask_pars_fragment>
		#include <specularmap_pars_fragment>
		#include <logdepthbuf_pars_fragment>
		#include <clipping_planes_pars_fragment>

		void main() {

			#include <clipping_planes_fragment>

			vec4 diffuseColor = vec4( diffuse, opacity );
			ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
			vec3 totalEmissiveRadiance = emissive;

			#include <logdepthbuf_fragment>
			#include <map_fragment>
			#include <color_fragment>
			#include <alphamap_fragment>
			#include <alphatest_fragment>
			#include <specularmap_fragment>
			#include <emissivemap_fragment>

			// accumulation

			#ifdef DOUBLE_SIDED

				reflectedLight.indirectDiffuse += ( gl_FrontFacing ) ? vIndirectFront : vIndirectBack;

			#else

				reflectedLight.indirectDiffuse += vIndirectFront;

			#endif

			#ifdef USE_LIGHTMAP

				vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
				vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
				reflectedLight.indirectDiffuse += lightMapIrradiance;

			#endif

			reflectedLight.indirectDiffuse *= BRDF_Lambert( diffuseColor.rgb );

			#ifdef DOUBLE_SIDED

				reflectedLight.directDiffuse = ( gl_FrontFacing ) ? vLightFront : vLightBack;

			#else

				reflectedLight.directDiffuse = vLightFront;

			#endif

			reflectedLight.directDiffuse *= BRDF_Lambert( diffuseColor.rgb ) * getShadowMask();

			// modulation

			#include <aomap_fragment>

			vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;

			#include <envmap_fragment>

			#include <opaque_fragment>
			#include <tonemapping_fragment>
			#include <colorspace_fragment>
			#include <fog_fragment>
			#include <premultiplied_alpha_fragment>
			#include <dithering_fragment>

		}`};class H1 extends Hi{static get type(){return"MeshGouraudMaterial"}constructor(t){super(),this.isMeshGouraudMaterial=!0,this.combine=ku,this.fog=!1,this.lights=!0,this.clipping=!1;const e=V1;this.defines=Object.assign({},e.defines),this.uniforms=Xu.clone(e.uniforms),this.vertexShader=e.vertexShader,this.fragmentShader=e.fragmentShader;const n=["map","lightMap","lightMapIntensity","aoMap","aoMapIntensity","emissive","emissiveIntensity","emissiveMap","specularMap","alphaMap","envMap","reflectivity","refractionRatio","opacity","diffuse"];for(const s of n)Object.defineProperty(this,s,{get:function(){return this.uniforms[s].value},set:function(r){this.uniforms[s].value=r}});Object.defineProperty(this,"color",Object.getOwnPropertyDescriptor(this,"diffuse")),this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}}const G1=`
precision highp float;
in vec3 position;
in vec3 normal;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform mat3 normalMatrix;
out vec3 vNormal;
out vec3 vView;
#ifdef MARKED
in float along;
out float vCentimetres;
#endif
void main() {
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  vNormal = normalMatrix * normal;
  vView = view.xyz;
#ifdef MARKED
  vCentimetres = 100.0 * along;
#endif
  gl_Position = projectionMatrix * view;
}`,W1=`
precision highp float;
in vec3 vNormal;
in vec3 vView;
uniform vec3 ink;
out vec4 colour;
#ifdef MARKED
in float vCentimetres;
#endif

float studio(vec3 way) {
  float ceiling = smoothstep(-0.3, 1.0, way.y);
  float lamp = exp(-40.0 * (way.y - 0.5) * (way.y - 0.5));
  return 0.30 + 0.45 * ceiling + 0.70 * lamp;
}

void main() {
  vec3 n = normalize(vNormal);
  vec3 eye = normalize(vView);
  float rim = 1.0 - abs(dot(n, eye));
  float light = studio(reflect(eye, n)) + 0.25 * rim * rim * rim;
  colour = vec4(ink * light, 1.0);
#ifdef MARKED
  float off = abs(fract(vCentimetres + 0.5) - 0.5);
  float soft = 0.5 * fwidth(vCentimetres);
  float fifth = step(abs(fract(0.2 * vCentimetres + 0.5) - 0.5), 0.05);
  float mark = 1.0 - smoothstep(-soft, soft, off - mix(0.035, 0.08, fifth));
  colour.rgb *= 1.0 - 0.72 * mark * step(0.5, vCentimetres);
#endif
}`;function N_(i,t){return new Kl({glslVersion:xo,vertexShader:G1,fragmentShader:W1,defines:t?{MARKED:1}:{},uniforms:{ink:{value:new re(i)}}})}const oi=10,ih=160,Xo=.028,X1=.012,Y1=.09,Gp=48,Il=512,hr=i=>new D(i.x,i.y,i.z),fr=(i,t={})=>new H1({color:i,...t});class q1{constructor(t){this.radius=t;const e=new en,n=ih*oi;this.places=new Fe(new Float32Array(3*n),3),this.normals=new Fe(new Float32Array(3*n),3),this.alongs=new Fe(new Float32Array(n),1),e.setAttribute("position",this.places),e.setAttribute("normal",this.normals),e.setAttribute("along",this.alongs);const s=[];for(let r=0;r+1<ih;++r)for(let o=0;o<oi;++o){const[a,l]=[r*oi+o,r*oi+(o+1)%oi];s.push(a,l,a+oi,l,l+oi,a+oi)}e.setIndex(s),this.mesh=new Ye(e,N_(ln.needle,!0)),this.mesh.frustumCulled=!1}show(t){const e=t.slice(0,ih-1);if(e.length<2)return;const n=new D,s=new D().subVectors(e[1],e[0]).normalize();n.set(Math.abs(s.x)>.9?0:1,Math.abs(s.x)>.9?1:0,0);let r=e.reduce((l,c,h)=>l+(h>0?c.distanceTo(e[h-1]):0),0);e.forEach((l,c)=>{c>0&&(r-=l.distanceTo(e[c-1]));const h=e[Math.min(c+1,e.length-1)],f=e[Math.max(c-1,0)];s.subVectors(h,f).normalize(),n.addScaledVector(s,-n.dot(s)).normalize(),this.ring(c,l,s,n,this.radius,r)});const o=e[e.length-1].clone(),a=4*this.radius;this.ring(e.length,o,s,n,0,0),this.ring(e.length-1,o.addScaledVector(s,-a),s,n,this.radius,a),this.mesh.geometry.setDrawRange(0,e.length*oi*6);for(const l of[this.places,this.normals,this.alongs])l.needsUpdate=!0}ring(t,e,n,s,r,o){const a=new D().crossVectors(n,s);for(let l=0;l<oi;++l){const c=2*Math.PI*l/oi,[h,f]=[Math.cos(c),Math.sin(c)],u=[0,1,2].map(_=>h*s.getComponent(_)+f*a.getComponent(_)),p=t*oi+l;this.normals.setXYZ(p,u[0],u[1],u[2]),this.alongs.setX(p,o),this.places.setXYZ(p,e.x+r*u[0],e.y+r*u[1],e.z+r*u[2])}}}class j1{constructor(t){this.info=t,this.group=new us,this.tube=new q1(Math.max(t.outerRadius,6e-4));const e=Math.max(5*t.outerRadius,.0035),n=new ra(e,.75*e,Xo,20);n.rotateX(Math.PI/2),n.translate(0,0,Xo/2),this.handle=new Ye(n,fr(ln.handle));const s=new Ao(1.1*e,.35*e,.5*Xo);s.translate(1.1*e,0,Xo/2),this.handle.add(new Ye(s,N_(ln.needle,!1))),this.arrow=new us;const r=fr(ln.force,{emissive:"#3d2900"});this.shaft=new Ye(new ra(.0011,.0011,1,12).translate(0,.5,0),r),this.head=new Ye(new Ju(.0034,.009,16).translate(0,.0045,0),r),this.arrow.add(this.shaft,this.head),this.group.add(this.tube.mesh,this.handle,this.arrow)}show(t){this.handle.position.copy(hr(t.handle));const e=t.handleRotation;this.handle.quaternion.set(e.x,e.y,e.z,e.w);const n=[this.handle.position,this.pointAhead()];this.tube.show(t.nodes.length>1?t.nodes.map(hr):n);const s=hr(t.force),r=s.length();if(this.arrow.visible=r>.02,!this.arrow.visible)return;const o=Math.min(Y1,X1*r),a=hr(t.handle).add(new D(0,0,Xo).applyQuaternion(this.handle.quaternion));this.arrow.position.copy(a),this.arrow.quaternion.setFromUnitVectors(new D(0,1,0),s.divideScalar(r)),this.shaft.scale.set(1,o,1),this.head.position.set(0,o,0)}pointAhead(){return new D(0,0,-this.info.length).applyQuaternion(this.handle.quaternion).add(this.handle.position)}}class sh{constructor(t,e){this.mesh=new r1(t,e,Il),this.mesh.frustumCulled=!1,this.mesh.count=0}show(t){const e=new Pe;this.mesh.count=Math.min(t.length,Il);for(let n=0;n<this.mesh.count;++n)this.mesh.setMatrixAt(n,e.makeTranslation(t[n].x,t[n].y,t[n].z));this.mesh.instanceMatrix.needsUpdate=!0}}function $1(i){const t=fr(ln.obstacle);let e;if(i.vertices.length===1){const r=i.vertices[0];e=new Zl(i.rounding,32,20),e.translate(r.x,r.y,r.z)}else{const r=i.rounding>0?Z1(i.rounding):[new D],o=i.vertices.flatMap(a=>r.map(l=>hr(a).add(l)));e=new z1(o)}const n=new Ye(e,t),s=i.rotation;return n.position.copy(hr(i.position)),n.quaternion.set(s.x,s.y,s.z,s.w),n}function Z1(i){const t=new lo(i,1).getAttribute("position");return Array.from({length:t.count},(e,n)=>new D().fromBufferAttribute(t,n))}function Wp(i,t,e){const n=i*Math.sqrt(1-e*e),s=r=>{const o=2*Math.PI*r/Gp,a=new D().setComponent(t,e*i);return a.setComponent((t+1)%3,n*Math.cos(o)),a.setComponent((t+2)%3,n*Math.sin(o))};return Array.from({length:Gp},(r,o)=>[s(o),s(o+1)]).flat()}function K1(i){const t=new us,e=i.forbidden?ln.forbidden:ln.target,n=Math.max(i.radius,.001),s=new Ye(new Zl(n,24,14),fr(e,{transparent:!0,opacity:.35,depthWrite:!1}));s.renderOrder=1,t.add(s);const r=i.forbidden?[-.75,-.4,0,.4,.75].map(a=>Wp(n,2,a)):[0,1,2].map(a=>Wp(n,a,0)),o=new en().setFromPoints(r.flat());return t.add(new Ku(o,new Zu({color:e}))),t.position.copy(hr(i.position)),t}class J1{constructor(t){this.group=new us,this.needles=t.needles.map(o=>new j1(o));const e=Math.min(.0014,t.voxelEdge/4);this.particles=new sh(new lo(e,2),fr(ln.particle));const n=fr(ln.goal,{transparent:!0,opacity:.75});this.goals=new sh(new lo(.8*e,1),n),this.touches=new sh(new lo(1.2*e,2),fr(ln.force));const s=new en;s.setAttribute("position",new Fe(new Float32Array(6*Il),3)),this.links=new Ku(s,new Zu({color:ln.goal})),this.links.frustumCulled=!1;const r=[...this.needles.map(o=>o.group),this.particles.mesh,this.goals.mesh,this.touches.mesh,this.links,...t.obstacles.filter(o=>o.vertices.length>0).map($1),...t.targets.map(K1)];this.group.add(...r)}show(t){t.needles.forEach((s,r)=>this.needles[r]?.show(s)),this.particles.show(t.particles.map(s=>s.position)),this.goals.show(t.particles.map(s=>s.goal)),this.touches.show(t.touches.map(s=>s.position));const e=this.links.geometry.getAttribute("position"),n=Math.min(t.particles.length,Il);for(let s=0;s<n;++s){const{position:r,goal:o}=t.particles[s];e.setXYZ(2*s,r.x,r.y,r.z),e.setXYZ(2*s+1,o.x,o.y,o.z)}e.needsUpdate=!0,this.links.geometry.setDrawRange(0,2*n)}showParticles(t){for(const e of[this.particles.mesh,this.goals.mesh,this.links])e.visible=t}}function Q1(i){i.traverse(t=>{const e=t;e.geometry?.dispose();for(const n of[e.material??[]].flat())n.dispose()})}const tT=.86,eT=[.72,.86,.78],nT=.035,iT=.3,sT=.05,rT=[0,1,2].flatMap(i=>[0,1,2,3,4,5,6,7].filter(t=>!(t&1<<i)).map(t=>[t,t|1<<i])),Xp=i=>1+nT*((Math.imul(i,2654435761)>>>24)/127.5-1);function oT(i){const t=new Map;for(let e=0;e<i.length;e+=3)for(let n=0;n<3;++n){const[s,r]=[i[e+n],i[e+(n+1)%3]],o=Math.min(s,r)*2**26+Math.max(s,r);t.delete(o)||t.set(o,[s,r])}return[...t.values()]}function aT(i,t){const e=oT(i.triangles),{voxelPlace:n,voxelSize:s,voxelCount:r,vertexVoxel:o}=i,a=[];if(e.length===0)return a;for(let l=0;l<3;++l){const c=(u,p)=>n[3*u+l]+p*s[u];let[h,f]=[1/0,-1/0];for(let u=0;u<r;++u)h=Math.min(h,c(u,0)),f=Math.max(f,c(u,1));for(const u of[0,1]){const p=u===1?f:h,_=w=>c(o[w],u)===p;if(e.filter(([w,v])=>_(w)&&_(v)).length<sT*e.length)continue;const[m,d]=[1<<(l+1)%3,1<<(l+2)%3],M=u<<l;for(let w=0;w<r;++w){if(c(w,u)!==p)continue;const v=[M,M+m,M+m+d,M+d].map(U=>t.corners[8*w+U]);a.push({voxel:w,corners:v,axis:l})}}}return a}function lT(i,t,e){const n=[];for(const[l,c]of rT){const[h,f]=[t[l],t[c]];h<0!=f<0&&n.push(i(l).lerp(i(c),h/(h-f)))}if(n.length<3)return null;const s=new D;for(const l of n)s.addScaledVector(l,1/n.length);const r=new D().subVectors(n[0],s).normalize(),o=new D().crossVectors(e,r),a=l=>{const c=l.clone().sub(s);return Math.atan2(c.dot(o),c.dot(r))};return n.map(l=>({point:l,at:a(l)})).sort((l,c)=>l.at-c.at).map(({point:l})=>l)}class Yp{constructor(){this.places=new Float32Array(0),this.colours=new Float32Array(0),this.count=0;const t=new jl({vertexColors:!0,side:ui});this.mesh=new Ye(new en,t),this.mesh.frustumCulled=!1}begin(){this.count=0}fan(t,e,n){this.grow(this.count+3*(t.length-2));for(let s=2;s<t.length;++s)for(const r of[t[0],t[s-1],t[s]]){r.toArray(this.places,3*this.count);for(let o=0;o<3;++o)this.colours[3*this.count+o]=n*e[o];++this.count}}finish(){const{geometry:t}=this.mesh;t.setDrawRange(0,this.count);for(const e of["position","color"]){const n=t.getAttribute(e);n&&(n.needsUpdate=!0)}}grow(t){if(3*t<=this.places.length)return;const[e,n]=[this.places,this.colours],s=3*Math.max(t,2*this.count,1024);this.places=new Float32Array(s),this.colours=new Float32Array(s),this.places.set(e),this.colours.set(n);const{geometry:r}=this.mesh;r.dispose(),r.setAttribute("position",new Fe(this.places,3)),r.setAttribute("color",new Fe(this.colours,3))}}class cT{constructor(t,e,n){this.organ=t,this.hello=e,this.group=new us,this.cut=new Yp,this.cropped=new Yp,this.quads=n?aT(t,e):[],this.tissues=yu(t.materials).map(r=>new re(r).toArray()),this.distances=new Float32Array(e.particles);const{material:s}=this.cut.mesh;s.stencilWrite=!n,s.stencilFunc=Nx,s.stencilZPass=s.stencilZFail=Fx,this.cut.mesh.renderOrder=this.cropped.mesh.renderOrder=2.5,this.group.add(this.cut.mesh,this.cropped.mesh)}setLook(t,e,n){this.cut.mesh.visible=e&&n,this.cropped.mesh.visible=n&&!t;const{material:s}=this.cut.mesh;s.transparent=t,s.opacity=t?iT:1,s.depthWrite=!t}move(t,e){this.cut.mesh.visible&&this.cutOpen(t,e),this.cropped.mesh.visible&&this.closeCropped(t,e)}place(t,e){const{rest:n,positionUnit:s}=this.hello,[r,o]=[3*t,4*t];return new D(n[r]+s*e[o],n[r+1]+s*e[o+1],n[r+2]+s*e[o+2])}tissue(t){return this.tissues[this.organ.voxelMaterial[t]]??[.5,.5,.5]}measure(t,e){const{rest:n,positionUnit:s}=this.hello;for(let r=0;r<this.distances.length;++r){const[o,a]=[3*r,4*r];this.distances[r]=e.x*(n[o]+s*t[a])+e.y*(n[o+1]+s*t[a+1])+e.z*(n[o+2]+s*t[a+2])-e.w}}cutOpen(t,e){this.measure(t,e),this.cut.begin();const n=new D(e.x,e.y,e.z),{corners:s}=this.hello;for(let r=0;r<this.organ.voxelCount;++r){let o=0;for(let c=0;c<8;++c)o+=this.distances[s[8*r+c]]<0?0:1;if(o===0||o===8)continue;const a=hT.map(c=>this.distances[s[8*r+c]]),l=lT(c=>this.place(s[8*r+c],t),a,n);l&&this.cut.fan(l,this.tissue(r),tT*Xp(r))}this.cut.finish()}closeCropped(t,e){this.cropped.begin();const n=s=>e.x*s.x+e.y*s.y+e.z*s.z>e.w;for(const{voxel:s,corners:r,axis:o}of this.quads){const a=r.map(l=>this.place(l,t));a.some(n)||this.cropped.fan(a,this.tissue(s),eT[o]*Xp(s))}this.cropped.finish()}}const hT=[0,1,2,3,4,5,6,7],Qo=256,O_=`
precision highp int;
precision highp isampler2D;
uniform isampler2D moved;
uniform float unit;

vec3 movedOf(uint particle) {
  return vec3(texelFetch(moved, ivec2(int(particle & 255u), int(particle >> 8u)), 0).xyz);
}
`,k_=`
${O_}
uniform float perEdge; // 1 / edge of a voxel
in uvec4 low;          // particles at z = 0 of the voxel, then those at z = 1
in uvec4 high;
in vec3 fraction;

void deform(vec3 rest, vec3 restNormal, out vec3 place, out vec3 normal) {
  vec3 d0 = movedOf(low.x), d1 = movedOf(low.y), d2 = movedOf(low.z), d3 = movedOf(low.w);
  vec3 d4 = movedOf(high.x), d5 = movedOf(high.y), d6 = movedOf(high.z), d7 = movedOf(high.w);
  vec3 f = fraction;
  vec3 y0 = mix(d0, d1, f.x), y1 = mix(d2, d3, f.x);
  vec3 y2 = mix(d4, d5, f.x), y3 = mix(d6, d7, f.x);
  vec3 z0 = mix(y0, y1, f.y), z1 = mix(y2, y3, f.y);
  place = rest + unit * mix(z0, z1, f.z);
  float scale = unit * perEdge;
  vec3 a = scale * mix(mix(d1 - d0, d3 - d2, f.y), mix(d5 - d4, d7 - d6, f.y), f.z);
  vec3 b = scale * mix(y1 - y0, y3 - y2, f.z);
  vec3 c = scale * (z1 - z0);
  a.x += 1.0;
  b.y += 1.0;
  c.z += 1.0;
  normal = restNormal.x * cross(b, c) + restNormal.y * cross(c, a) + restNormal.z * cross(a, b);
}
`;function uT(i){const t=Math.max(1,Math.ceil(i.particles/Qo)),e=new $u(new Int16Array(4*Qo*t),Qo,t,Xl,Bu);return e.internalFormat="RGBA16I",e.minFilter=e.magFilter=Ln,e.generateMipmaps=!1,e.unpackAlignment=1,e.needsUpdate=!0,{texture:e,uniforms:{moved:{value:e},unit:{value:i.positionUnit},perEdge:{value:1/i.voxelEdge}}}}function qp(i,t){i.texture.image.data.set(t),i.texture.needsUpdate=!0}function B_(i,t){const e=i.vertexVoxel.length,n=new Uint32Array(4*e),s=new Uint32Array(4*e);for(let a=0;a<e;++a){const l=t.corners.subarray(8*i.vertexVoxel[a],8*i.vertexVoxel[a]+8);n.set(l.subarray(0,4),4*a),s.set(l.subarray(4,8),4*a)}const r=a=>{const l=new Fe(a,4);return l.gpuType=Wl,l},o=new en;return o.setAttribute("position",new Fe(i.vertexRest,3)),o.setAttribute("normal",new Fe(i.vertexNormal,3)),o.setAttribute("fraction",new Fe(i.vertexFraction,3)),o.setAttribute("low",r(n)),o.setAttribute("high",r(s)),o.setIndex(new Fe(i.triangles,1)),o}function fT(i,t,e,n,s){const r=t.vertexVoxel.length,[o,a]=[Qo,Math.ceil(r/Qo)],l=new Ds(o,a,{type:Ti,minFilter:Ln,magFilter:Ln,depthBuffer:!1}),c=new Kl({glslVersion:xo,uniforms:{...n.uniforms,size:{value:new $t(o,a)}},vertexShader:`precision highp float;
      ${k_}
      in vec3 position;
      in vec3 normal;
      uniform vec2 size;
      out vec3 at;
      void main() {
        vec3 place, turned;
        deform(position, normal, place, turned);
        at = ${s?"turned":"place"};
        vec2 cell = vec2(float(gl_VertexID & 255), float(gl_VertexID >> 8));
        gl_Position = vec4((cell + 0.5) / size * 2.0 - 1.0, 0.0, 1.0);
        gl_PointSize = 1.0;
      }`,fragmentShader:`precision highp float;
      in vec3 at;
      out vec4 colour;
      void main() { colour = vec4(at, 1.0); }`,depthTest:!1,depthWrite:!1,blending:ps}),h=B_(t,e).setIndex(null),f=new l1(h,c);f.frustumCulled=!1;const u=new F_;u.add(f),i.setRenderTarget(l),i.render(u,new Yu);const p=new Float32Array(4*o*a);i.readRenderTargetPixels(l,0,0,o,a,p),i.setRenderTarget(null);for(const b of[l,c,h])b.dispose();const _=new Float32Array(3*r);for(let b=0;b<r;++b)_.set(p.subarray(4*b,4*b+3),3*b);return _}const Si=48,dT=.35,rh=3,pT=.3;function mT(i){const t=new Float32Array(i.length);for(let e=0;e<Si;++e)for(let n=0;n<Si;++n){let s=0;for(let r=-rh;r<=rh;++r){const o=n+r;o>=0&&o<Si&&(s+=i[Si*e+o])}t[Si*n+e]=s/(2*rh+1)}return t}function _T(i,t){const e=new D(t.y,t.z,t.x),n=new D().crossVectors(t,e),s=(b,m)=>b.x*i[m]+b.y*i[m+1]+b.z*i[m+2],r=[1/0,1/0,1/0],o=[-1/0,-1/0,-1/0];for(let b=0;b<i.length;b+=3)[e,n,t].forEach((m,d)=>{r[d]=Math.min(r[d],s(m,b)),o[d]=Math.max(o[d],s(m,b))});const a=(1+2*dT)*Math.max(o[0]-r[0],o[1]-r[1],.001),l=[(r[0]+o[0])/2,(r[1]+o[1])/2];let c=new Float32Array(Si*Si);for(let b=0;b<i.length;b+=3){const[m,d]=[e,n].map((M,w)=>Math.floor(Si*((s(M,b)-l[w])/a+.5)));c[Si*d+m]=1}for(let b=0;b<6;++b)c=mT(c);const h=new Uint8Array(4*c.length);c.forEach((b,m)=>h[4*m+3]=255*pT*b);const f=new $u(h,Si,Si);f.minFilter=f.magFilter=Ei,f.needsUpdate=!0;const u=new jl({map:f,transparent:!0,depthWrite:!1});u.addEventListener("dispose",()=>f.dispose());const p=new Ye(new la(a,a),u);p.matrixAutoUpdate=!1,p.matrix.makeBasis(e,n,t);const _=e.clone().multiplyScalar(l[0]).addScaledVector(n,l[1]);return p.matrix.setPosition(_.addScaledVector(t,r[2])),p.renderOrder=-1,p}function z_(i,t){const{vertexVoxel:e,vertexFraction:n,vertexRest:s,vertexNormal:r}=i,[o,a]=[s.slice(),r.slice()],l=t.positionUnit/t.voxelEdge,c=t.corners.map(b=>4*b),h=new Float64Array(9),f=b=>{for(let m=0;m<e.length;++m){const[d,M]=[8*e[m],3*m],[w,v,U]=[n[M],n[M+1],n[M+2]];for(let S=0;S<3;++S){const x=b[c[d]+S],A=b[c[d+1]+S]-x,V=b[c[d+2]+S],N=b[c[d+3]+S]-V,Y=b[c[d+4]+S],X=b[c[d+5]+S]-Y,J=b[c[d+6]+S],K=b[c[d+7]+S]-J,et=x+w*A,ct=V+w*N-et,ht=Y+w*X,_t=J+w*K-ht,vt=et+v*ct,pt=ht+v*_t-vt,[st,lt]=[A+v*(N-A),X+v*(K-X)];o[M+S]=s[M+S]+t.positionUnit*(vt+U*pt),h[S]=l*(st+U*(lt-st)),h[3+S]=l*(ct+U*(_t-ct)),h[6+S]=l*pt}h[0]+=1,h[4]+=1,h[8]+=1;const[P,L,F]=[r[M],r[M+1],r[M+2]];for(let S=0;S<3;++S){const x=(S+1)%3,A=(S+2)%3;a[M+S]=P*(h[3+x]*h[6+A]-h[3+A]*h[6+x])+L*(h[6+x]*h[A]-h[6+A]*h[x])+F*(h[x]*h[3+A]-h[A]*h[3+x])}}},{triangles:u}=i,p=u.slice();return{places:o,normals:a,move:f,all:u,facing:p,face:b=>{let m=0;for(let d=0;d<u.length;d+=3){const M=3*u[d],w=3*u[d+1],v=3*u[d+2],U=o[M],P=o[M+1],L=o[M+2],F=o[w]-U,S=o[w+1]-P,x=o[w+2]-L,A=o[v]-U,V=o[v+1]-P,N=o[v+2]-L;(S*N-x*V)*(b.x-U)+(x*A-F*N)*(b.y-P)+(F*V-S*A)*(b.z-L)<=0||(p[m++]=u[d],p[m++]=u[d+1],p[m++]=u[d+2])}return m}}}const gT=`
precision highp float;
in vec3 position;
in vec3 normal;
in vec3 colour;
#ifdef BY_GPU
${k_}
#endif
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform mat3 normalMatrix;
uniform float clear;  // 0 solid, 1 x-ray
uniform vec3 upward;
uniform vec4 touched[NEEDLES];  // where a needle meets the surface, and how far its shade goes
uniform vec3 outward[NEEDLES];  // along the needle
out vec4 vColour;
#ifdef CUT
out vec3 vPlace;
out vec3 vInside;
uniform vec3 inside;
#endif

const vec3 kLamp = vec3(-0.4767, 0.6674, 0.5721);
const vec3 kPale = vec3(1.0, 0.90, 0.84);

// How much light comes past the needles.
float besideNeedles(vec3 place) {
  float light = 1.0;
  for (int i = 0; i < NEEDLES; ++i) {
    vec3 from = place - touched[i].xyz;
    from -= max(0.0, dot(from, outward[i])) * outward[i];
    light *= 1.0 - 0.55 * exp(-dot(from, from) / (touched[i].w * touched[i].w));
  }
  return light;
}

void main() {
  vec3 place = position;
  vec3 turned = normal;
#ifdef BY_GPU
  deform(position, normal, place, turned);
#endif
  vec4 view = modelViewMatrix * vec4(place, 1.0);
  float stretch = length(turned);  // of the surface, by area: normals at rest have length 1
  vec3 n = normalMatrix * turned / stretch;
  vec3 eye = -normalize(view.xyz);
  float facing = max(0.0, dot(n, eye));
  float lamp = max(0.0, (dot(n, kLamp) + 0.4) / 1.4);
  float sky = 0.5 + 0.5 * dot(n, normalMatrix * upward);
  float lit = 0.32 + 0.26 * facing + 0.38 * lamp * lamp + 0.12 * sky;
  float shine = max(0.0, dot(n, normalize(kLamp + eye)));
  shine *= shine;
  shine *= shine;
  shine *= shine;
  shine *= shine * shine;  // to the 24th
  float rim = 1.0 - facing;
  vec3 tissue = mix(colour, kPale, 0.6 * smoothstep(0.02, 0.4, stretch - 1.0));
  tissue *= 1.0 - 0.4 * smoothstep(0.02, 0.5, 1.0 - stretch);
  tissue = mix(tissue * tissue, tissue, min(1.0, 0.25 + 0.85 * lit));
  float past = besideNeedles(place);
  vColour = vec4(past * (tissue * lit + 0.22 * shine), mix(1.0, 0.16 + 0.62 * rim * rim, clear));
#ifdef CUT
  vPlace = place;
  vInside = mix(inside, colour, 0.25);
#endif
  gl_Position = projectionMatrix * view;
}`,bT=`
precision mediump float;
in vec4 vColour;
out vec4 colour;
#ifdef CUT
in highp vec3 vPlace;
in vec3 vInside;
uniform highp vec4 plane;  // what lies beyond it is not drawn
uniform highp float clear;
#endif
void main() {
  colour = vColour;
#ifdef CUT
  if (dot(plane.xyz, vPlace) > plane.w) discard;
  if (gl_FrontFacing || clear > 0.5) return;
  colour = vec4(vInside, 1.0);
#endif
}`,vT=`
precision highp float;
${O_}
in vec3 position;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
out vec3 vPlace;
void main() {
  vPlace = position + unit * movedOf(uint(gl_VertexID));
  gl_Position = projectionMatrix * modelViewMatrix * vec4(vPlace, 1.0);
}`,xT=`
precision highp float;
in vec3 vPlace;
uniform vec4 plane;
uniform vec3 ink;
out vec4 colour;
void main() {
  if (dot(plane.xyz, vPlace) > plane.w) discard;
  colour = vec4(ink, 0.45);
}`,MT=1e-6,yT=1.3,ST=6;function wT(i){const t=yu(i.materials).map(n=>new re(n).toArray()),e=new Float32Array(3*i.vertexVoxel.length);return i.vertexVoxel.forEach((n,s)=>{e.set(t[i.voxelMaterial[n]]??[.5,.5,.5],3*s)}),e}function ET(i,t,e,n,s){const r=s?null:z_(i,t),o=r?AT(i,r):B_(i,t);o.setAttribute("colour",new Fe(wT(i),3));const a=Math.max(1,t.needles.length),l=new Kl({glslVersion:xo,vertexShader:gT,fragmentShader:bT,defines:{NEEDLES:a,...s?{BY_GPU:1}:{}},uniforms:{...e.uniforms,plane:n,clear:{value:0},inside:{value:new re(ln.inside)},upward:{value:new D(0,1,0)},touched:{value:Array.from({length:a},()=>new He(0,0,0,MT))},outward:{value:Array.from({length:a},()=>new D)}}}),c=new Ye(o,l);c.frustumCulled=!1,c.renderOrder=2;const h=nb(i.triangles),f=[Cn,Vi].map(u=>TT(c,u));return{skin:r,open:h,mesh:c,counters:f,lattice:IT(i,t,e,n)}}function TT(i,t){const e=i.material.clone();e.uniforms=i.material.uniforms,e.defines={...i.material.defines,CUT:1},e.side=t,e.colorWrite=e.depthWrite=e.depthTest=!1,e.stencilWrite=!0;const n=t===Cn?Dx:Ux;e.stencilZPass=e.stencilZFail=n;const s=new Ye(i.geometry,e);return s.frustumCulled=!1,s.visible=!1,s.renderOrder=1.5,s}function AT(i,t){const e=new en;for(const[s,r]of[["position",t.places],["normal",t.normals]]){const o=new Fe(r,3);o.usage=Id,e.setAttribute(s,o)}const n=new Fe(t.facing,1);return n.usage=Id,e.setIndex(n),e}function RT({skin:i,mesh:t},e){const{geometry:n}=t;if(i===null||n.index===null)return;const s=t.material.side===ui;s&&i.facing.set(i.all),n.setDrawRange(0,s?i.facing.length:i.face(e)),n.index.needsUpdate=!0}function PT({skin:i,mesh:t},e){if(i!==null){i.move(e);for(const n of["position","normal"])t.geometry.getAttribute(n).needsUpdate=!0}}function CT({nodes:i,depth:t}){const e=new D,n=new D;let s=t;for(let r=i.length-1;r>0;--r){e.copy(i[r]),n.copy(i[r-1]).sub(e);const o=n.length();if(n.divideScalar(Math.max(o,1e-9)),e.addScaledVector(n,Math.min(s,o)),s<=o)break;s-=o}return{at:e,outward:n}}function LT({mesh:i},t,e){const{touched:n,outward:s}=i.material.uniforms;e.forEach((r,o)=>{if(n.value[o]===void 0||r.nodes.length<2)return;const a=CT(r),l=ST*(t.needles[o]?.outerRadius??0),c=Math.max(l,yT*t.voxelEdge);n.value[o].set(a.at.x,a.at.y,a.at.z,c),s.value[o].copy(a.outward)})}function IT(i,t,e,n){const s=new en;s.setAttribute("position",new Fe(t.rest,3)),s.setIndex(new Fe(sb(i,t.corners),1));const r=new Kl({glslVersion:xo,vertexShader:vT,fragmentShader:xT,uniforms:{...e.uniforms,plane:n,ink:{value:new re(ln.lattice)}},transparent:!0}),o=new Ku(s,r);return o.frustumCulled=!1,o.renderOrder=3,o}function FT(i,t,e){const n=i.mesh.material,s=e||i.open;n.uniforms.clear.value=t?1:0,n.transparent=t,n.depthWrite=!t,n.side=s?ui:Vi;const{CUT:r,...o}=n.defines;n.defines=s?{...o,CUT:1}:o,n.needsUpdate=!0;for(const a of i.counters)a.visible=e&&!i.open}function DT(){const i=document.createElement("canvas").getContext("webgl2");if(i===null)return!1;const t=i.getExtension("WEBGL_debug_renderer_info"),e=String(i.getParameter(t?t.UNMASKED_RENDERER_WEBGL:i.RENDERER));return i.getExtension("WEBGL_lose_context")?.loseContext(),/swiftshader|llvmpipe|softpipe|software|basic render/i.test(e)}const jp=60,$p=2,UT=300,NT=2,oh=3e-5,OT=.01;class kT{constructor(){this.pictures=0,this.kept={message:[],deform:[],bodies:[],caps:[],face:[],draw:[]},this.drawn=[]}time(t,e){const n=performance.now(),s=e(),r=this.kept[t];return r.push(performance.now()-n),r.length>jp&&r.shift(),s}clear(){this.kept={message:[],deform:[],bodies:[],caps:[],face:[],draw:[]}}tick(){for(++this.pictures,this.drawn.push(performance.now());this.drawn.length>2*jp;)this.drawn.shift()}perSecond(){const t=performance.now()-1e3;return this.drawn.filter(e=>e>t).length}median(t){const e=[...this.kept[t]].sort((n,s)=>n-s);return e[e.length>>1]??0}}class BT{constructor(t,e,n){this.canvas=t,this.store=e,this.budget=new kT,this.byGpu=!DT(),this.look={xray:!1,lattice:!1,particles:!1,surface:!0,cut:!1,cutAt:.5},this.finish=!1,this.always=!1,this.scale=1,this.drawn=()=>{},this.scene=new F_,this.plane={value:new He(0,0,0,1)},this.deformation=null,this.surface=null,this.caps=null,this.bodies=null,this.ground=null,this.stale=!0,this.movedAt=0,this.rested=!1,this.drawnFrame=null,this.drawnMoved=new Int16Array,this.fresh=!1,this.capsStale=!0,fe.enabled=!1,this.renderer=new i1({canvas:t,antialias:this.byGpu,alpha:!0,powerPreference:"high-performance",preserveDrawingBuffer:!1,stencil:!0}),this.renderer.outputColorSpace=br,this.renderer.setClearColor(0,0),this.cameraMan=new U1(t,n,()=>this.stale=!0),this.cameraMan.camera.add(new u1("#ffffff",1.5).translateX(-.5).translateY(.7).translateZ(.8)),this.scene.add(this.cameraMan.camera,new f1("#ffffff",1.1)),e.on(["organ"],()=>this.rebuild()),e.on(["frame"],()=>{this.seenToMove()&&(this.fresh=this.stale=!0)}),new ResizeObserver(()=>this.resize()).observe(t),t.addEventListener("webglcontextlost",s=>s.preventDefault()),t.addEventListener("webglcontextrestored",()=>this.rebuild())}setLook(t){Object.assign(this.look,t),this.applyLook()}preset(t,e=this.cameraMan.still()){const{frame:n,needle:s}=this.store;this.cameraMan.look(t,n?.needles[s]?.tip??null,e),this.stale=!0}project(t){const e=new D(t.x,t.y,t.z).project(this.cameraMan.camera);if(e.z>1)return null;const{clientWidth:n,clientHeight:s}=this.canvas;return{x:(e.x+1)/2*n,y:(1-e.y)/2*s}}pixelAt(t){const{camera:e}=this.cameraMan,s=2*-new D(...t).applyMatrix4(e.matrixWorldInverse).z*Math.tan(e.fov*Math.PI/360)/this.canvas.clientHeight,[r,o]=[new D,new D];return e.matrixWorld.extractBasis(r,o,new D),{right:r.multiplyScalar(s).toArray(),down:o.multiplyScalar(-s).toArray()}}deformedVertices(t,e=!1){const{organ:n,hello:s,moved:r}=this.store;if(n===null||s===null||this.deformation===null)return new Float32Array;if(t)return qp(this.deformation,r),fT(this.renderer,n,s,this.deformation,e);const o=z_(n,s);return o.move(r),e?o.normals:o.places}rebuild(){const{hello:t,organ:e}=this.store,n=this.surface?.counters??[];for(const r of[this.bodies?.group,this.caps?.group,this.surface?.mesh,this.surface?.lattice,this.ground,...n])r&&(this.scene.remove(r),Q1(r));if(this.deformation?.texture.dispose(),t===null||e===null)return;this.deformation=uT(t),this.surface=ET(e,t,this.deformation,this.plane,this.byGpu),this.bodies=new J1(t),this.caps=new cT(e,t,this.surface.open),this.scene.add(this.surface.mesh,this.surface.lattice,...this.surface.counters,this.caps.group,this.bodies.group),this.look.cutAt=this.besideNeedle();const s=Bp(t);this.ground=_T(t.rest,s.up),this.scene.add(this.ground),this.surface.mesh.material.uniforms.upward.value.copy(s.up),this.cameraMan.setScene(s),this.resize(),this.applyLook(),this.drawnFrame=null,this.fresh=this.store.frame!==null}applyLook(){if(this.stale=!0,this.surface===null||this.bodies===null||this.caps===null)return;const{xray:t,lattice:e,particles:n,surface:s,cut:r,cutAt:o}=this.look;FT(this.surface,t,r),this.caps.setLook(t,r,s),this.surface.mesh.visible=s;for(const f of this.surface.counters)f.visible&&=s;this.surface.lattice.visible=e,this.bodies.showParticles(n);const{across:a,low:l,high:c}=this.acrossNeedle(),h=r?c-o*(c-l):1e3;this.plane.value.set(a.x,a.y,a.z,h),this.capsStale=!0}acrossNeedle(){const{hello:t}=this.store,e=new D;if(t===null)return{across:e,low:0,high:1};const{direction:n,up:s}=Bp(t);e.crossVectors(n,s).normalize();let[r,o]=[1/0,-1/0];for(let a=0;a<t.rest.length;a+=3){const l=e.x*t.rest[a]+e.y*t.rest[a+1]+e.z*t.rest[a+2];r=Math.min(r,l),o=Math.max(o,l)}return{across:e,low:r,high:o}}besideNeedle(){const t=this.store.hello?.needles[0],{across:e,low:n,high:s}=this.acrossNeedle();if(!t||!(s>n))return .5;const{x:r,y:o,z:a}=t.entry,l=e.dot(new D(r,o,a))-NT*t.outerRadius;return Math.min(.98,Math.max(.02,(s-l)/(s-n)))}resize(){const{clientWidth:t,clientHeight:e}=this.canvas;t===0||e===0||(this.renderer.setSize(t,e,!1),this.cameraMan.camera.aspect=t/e,this.cameraMan.camera.updateProjectionMatrix(),this.stale=!0)}seenToMove(){const{frame:t,moved:e}=this.store,{drawnFrame:n,drawnMoved:s}=this;if(t===null||n===null||e.length!==s.length||t.particles.length!==n.particles.length)return!0;const r=(l,c)=>Math.hypot(l.x-c.x,l.y-c.y,l.z-c.z);if(t.needles.some(({nodes:l,handle:c,force:h},f)=>{const u=n.needles[f];return l.length!==u?.nodes.length||r(c,u.handle)>oh||r(h,u.force)>OT||l.some((p,_)=>r(p,u.nodes[_])>oh)}))return!0;const a=oh/(this.store.hello?.positionUnit??1);return e.some((l,c)=>Math.abs(l-s[c])>a)}step(){if(this.always&&(this.fresh=this.stale=this.store.frame!==null),this.cameraMan.move(performance.now())&&(this.stale=!0),this.canvas.clientWidth===0)return;const t=!this.stale&&performance.now()-this.movedAt>UT;if(!this.stale&&(!t||this.rested))return;this.stale&&(this.movedAt=performance.now()),this.rested=t,this.setSharpness(t),this.stale=!1;const{frame:e}=this.store;if(this.fresh&&e!==null&&this.deformation!==null){const n=this.deformation;this.budget.time("deform",()=>{qp(n,this.store.moved),this.surface&&PT(this.surface,this.store.moved)}),this.budget.time("bodies",()=>this.bodies?.show(e));const{hello:s}=this.store;this.surface&&s&&LT(this.surface,s,e.needles),this.fresh=!1,this.capsStale=!0,this.drawnFrame=e,this.drawnMoved=this.store.moved.slice()}this.capsStale&&(this.budget.time("caps",()=>this.caps?.move(this.store.moved,this.plane.value)),this.capsStale=!1),this.budget.time("face",()=>{this.surface&&RT(this.surface,this.cameraMan.camera.position)}),this.budget.time("draw",()=>{this.renderer.render(this.scene,this.cameraMan.camera),this.finish&&this.waitForGpu()}),this.budget.tick(),this.drawn()}setSharpness(t){const e=Math.min(window.devicePixelRatio,$p),n=this.scale*(this.byGpu?e:Math.min(e,1)),s=t?this.byGpu?e:$p:n;this.renderer.getPixelRatio()!==s&&this.renderer.setPixelRatio(s)}waitForGpu(){const t=this.renderer.getContext();t.readPixels(0,0,1,1,t.RGBA,t.UNSIGNED_BYTE,new Uint8Array(4))}}const Ka=6,ah=.9,Ja=["surface","xray","lattice","particles","cut"],zT={trainee:{surface:!0,xray:!1,lattice:!1,particles:!1,cut:!1},teacher:{surface:!0,xray:!0,lattice:!1,particles:!1,cut:!1},engineer:{surface:!0,xray:!0,lattice:!0,particles:!0,cut:!1}};class VT{constructor(t){this.store=t,this.canvas=tt("canvas",{id:"scene-canvas",tabindex:0,role:"application","aria-label":O.view3d.canvas}),this.view=null,this.cutAt=tt("input",{type:"range",min:0,max:1,step:.01,value:.5,"aria-label":O.view3d.cutAt,hidden:!0}),this.rate=tt("span",{class:"rate",title:O.view3d.frameRateLabel}),this.legend=tt("ul",{class:"key","aria-label":O.view3d.legend}),this.labels=tt("div",{class:"labels","aria-hidden":"true"}),this.organText=tt("span",{class:"organ-text"}),this.looks=structuredClone(zT),this.switches=Object.fromEntries(Ja.map(n=>[n,ph(O.view3d[n],s=>this.change({[n]:s}))]));const e=kp.map(n=>$e(O.view3d.presets[n],()=>this.view?.preset(n)));this.root=tt("section",{class:"scene","aria-label":O.view3d.label,id:"scene"},this.canvas,this.labels,tt("div",{class:"scene-top"},this.legend,tt("div",{class:"scene-numbers"},this.organText,this.rate)),tt("div",{class:"scene-tools"},tt("div",{class:"group",role:"group","aria-label":O.view3d.presetsLabel},...e),tt("div",{class:"group looks",role:"group","aria-label":O.view3d.toolbar},...Ja.map(n=>this.switches[n]),this.cutAt))),this.cutAt.addEventListener("input",()=>this.view?.setLook({cutAt:Number(this.cutAt.value)})),this.canvas.addEventListener("keydown",n=>this.key(n)),t.on(["view"],()=>this.applyView()),t.on(["organ"],()=>this.applyOrgan()),window.setInterval(()=>this.showRate(),500)}begin(){try{this.view=new BT(this.canvas,this.store,Ug)}catch{return!1}return this.view.drawn=()=>this.placeLabels(),this.applyView(),!0}setLook(t){for(const e of Ja)t[e]!==void 0&&ml(this.switches[e],t[e]);this.change(t)}change(t){Object.assign(this.looks[this.store.view]??={},t),this.view?.setLook(t),this.cutAt.hidden=!(this.view?.look.cut??!1),this.cutAt.value=String(this.view?.look.cutAt??.5),this.drawLegend()}applyView(){const t=this.looks[this.store.view];if(t!==void 0){for(const e of Ja)ml(this.switches[e],t[e]===!0);this.change(t)}}applyOrgan(){const{organ:t}=this.store;t!==null&&(xn(this.organText,O.loop.voxels(t.voxelCount,t.triangles.length/3)),this.labels.replaceChildren(...(this.store.hello?.targets??[]).map(e=>tt("span",{},e.name))),this.drawLegend())}drawLegend(){const{organ:t,hello:e}=this.store,n=this.view?.look;if(t===null||e===null||n===void 0)return;const s=new Set;for(const a of t.vertexVoxel)s.add(t.voxelMaterial[a]);if(n.cut)for(const a of t.voxelMaterial)s.add(a);const r=yu(t.materials),o=[...s].sort((a,l)=>a-l).map(a=>[t.materials[a]??"",r[a],"dot"]);n.particles&&(o.push([O.view3d.legendParticle,ln.particle,"dot"]),o.push([O.view3d.legendGoal,ln.goal,"dot"])),n.lattice&&o.push([O.view3d.legendLattice,ln.lattice,"line"]),e.targets.some(a=>!a.forbidden)&&o.push([O.view3d.legendTarget,ln.target,"ring"]),e.targets.some(a=>a.forbidden)&&o.push([O.view3d.legendForbidden,ln.forbidden,"bars"]),o.push([O.view3d.legendForce,ln.force,"line"]),this.legend.replaceChildren(...o.map(([a,l,c])=>{const h=tt("span",{class:`sign ${c}`});return h.style.setProperty("--sign",l),tt("li",{},h,a)}))}placeLabels(){const t=this.store.view!=="trainee",e=this.store.hello?.targets??[],s=[...this.labels.children].map((o,a)=>{const l=t&&e[a]?this.view?.project(e[a].position):null,{style:c}=o;return c.display=l?"":"none",{label:o,at:l??null}}).flatMap(({label:o,at:a})=>a?[{label:o,x:a.x,y:a.y}]:[]),r=Kv(s.map(({label:o,x:a,y:l})=>({x:a,y:l,width:o.offsetWidth,height:o.offsetHeight})));s.forEach(({label:o,x:a},l)=>{o.style.transform=`translate(${a.toFixed(1)}px, ${r[l].toFixed(1)}px)`})}showRate(){xn(this.rate,O.view3d.frameRate(this.view?.budget.perSecond()??0))}key(t){if(t.altKey||t.ctrlKey||t.metaKey||this.view===null)return;const e=this.view.cameraMan,n=a=>()=>this.switches[a].click(),s=this.store.view==="trainee",o={ArrowLeft:()=>e.nudge(-Ka,0,1),ArrowRight:()=>e.nudge(Ka,0,1),ArrowUp:()=>e.nudge(0,Ka,1),ArrowDown:()=>e.nudge(0,-Ka,1),"+":()=>e.nudge(0,0,ah),"=":()=>e.nudge(0,0,ah),"-":()=>e.nudge(0,0,1/ah),...s?{}:{x:n("xray"),l:n("lattice"),p:n("particles"),c:n("cut")},...Object.fromEntries(kp.map((a,l)=>[String(l+1),()=>this.view?.preset(a)]))}[t.key];o!==void 0&&(t.preventDefault(),o())}}class HT{constructor(){this.hello=null,this.organ=null,this.frame=null,this.moved=new Int16Array,this.series=[],this.events=[],this.allMarks=[],this.scores=[],this.view="trainee",this.needle=0,this.untold=new Set,this.listeners=new Map}on(t,e){for(const n of t)this.listeners.set(n,[...this.listeners.get(n)??[],e])}tell(t){for(const e of this.listeners.get(t)??[])e()}get playback(){return(this.hello?.recordingTicks??0)>0}get marks(){const t=this.frame?.attempt??0;return this.allMarks.filter(e=>e.attempt===t)}get period(){return this.hello?.period??.001}get rows(){return this.series[this.needle]??GT}seconds(t){return t*this.period}layerName(t){return this.organ?.materials[t]??""}take(t){switch(t.kind){case"hello":this.begin(t);break;case"frame":this.advance(t);break;case"rows":for(const e of t.rows)this.series[e.needle]?.add(e);this.addEvents(t.events),this.tell("rows");break;case"score":this.scores=[...this.scores.filter(e=>e.attempt!==t.attempt),t],this.tell("scores");break;case"marked":this.allMarks=[...this.allMarks,t].sort((e,n)=>e.attempt-n.attempt||e.tick-n.tick),this.tell("marks"),this.tell("rows");break}}select(t){this.view=t,this.tell("view")}begin(t){this.hello=t,this.moved=new Int16Array(4*t.particles),this.frame=null,this.needle=Math.min(this.needle,t.needles.length-1),this.series=t.needles.map(()=>new hm),this.events=[],this.allMarks=[],this.tell("hello"),this.tell("rows")}advance(t){if(this.hello===null)return;const e=this.frame;!this.playback&&e!==null&&t.tick<e.tick&&this.forget(),this.frame=t,this.move(t);for(const n of t.rows)this.series[n.needle]?.add(n);this.addEvents(t.events),this.untold.add("frame"),(t.rows.length>0||t.events.length>0)&&this.untold.add("rows")}flush(){const t=[...this.untold];this.untold.clear();for(const e of t)this.tell(e)}move(t){const{movedIndex:e,movedTo:n,key:s}=t,r=n.length/3;for(let o=0;o<r;++o){const a=s?o:e[o];if(!(4*a+3>=this.moved.length))for(let l=0;l<3;++l)this.moved[4*a+l]=n[3*o+l]}}forget(){for(const t of this.series)t.clear();this.events=[],this.tell("rows")}addEvents(t){if(t.length===0)return;const e=r=>`${r.tick} ${r.eventKind} ${r.needle}`,n=new Set(this.events.map(e)),s=t.filter(r=>!n.has(e(r)));this.events=[...this.events,...s].sort((r,o)=>r.tick-o.tick)}}const GT=new hm,V_=i=>i===On.Running||i===On.Paused,Bi=["trainee","teacher","engineer","report"],Zp=i=>i.replace(/\.toml$/,"");class WT{constructor(t,e,n){this.store=t,this.send=e,this.scene=tt("select",{"aria-label":O.session.scene}),this.trainee=tt("input",{type:"text",maxlength:60,autocomplete:"off",placeholder:O.session.trainee,"aria-label":`${O.session.trainee}: ${O.session.traineeHint}`}),this.main=$e("",()=>this.act(),{class:"primary"}),this.end=$e(O.session.end,()=>this.send(Jn.end())),this.reset=$e(O.session.reset,()=>this.send(Jn.reset())),this.clear=$e(O.session.acknowledge,()=>this.acknowledge(),{class:"warning"}),this.state=tt("span",{class:"activity",role:"status"}),this.clock=tt("span",{class:"clock"}),this.tabs=Bi.map(r=>$e(O.views[r],()=>t.select(r),{role:"tab",id:`tab-${r}`,"aria-controls":"main"}));const s=tt("div",{role:"tablist",class:"tabs","aria-label":O.viewsLabel},...this.tabs);s.addEventListener("keydown",r=>this.walkTabs(r)),this.controls=tt("div",{class:"controls",role:"group","aria-label":O.session.label},this.scene,this.trainee,this.main,this.end,this.reset,this.clear),this.root=tt("header",{class:"top"},tt("h1",{},O.brand),s,this.controls,tt("div",{class:"state"},this.state,this.clock),$e(O.help.open,n,{class:"quiet","aria-keyshortcuts":"?"})),this.scene.addEventListener("change",()=>e(Jn.choose(this.scene.value))),t.on(["hello"],()=>this.begin()),t.on(["frame","link"],()=>this.show()),t.on(["view"],()=>this.showTabs())}act(){const{hello:t,frame:e}=this.store;t===null||!t.mayControl||this.store.playback||(e?.activity===On.Running?this.send(Jn.pause()):e?.activity===On.Paused?this.send(Jn.resume()):this.send(Jn.start(this.trainee.value.trim())))}acknowledge(){const{frame:t}=this.store;t?.needles.forEach((e,n)=>{e.fault!==""&&this.send(Jn.acknowledge(t,n))})}walkTabs(t){const e=Bi.indexOf(this.store.view),n={ArrowLeft:e-1,ArrowRight:e+1,Home:0,End:Bi.length-1}[t.key];if(n===void 0)return;t.preventDefault();const s=Bi[(n+Bi.length)%Bi.length];this.store.select(s),this.tabs[Bi.indexOf(s)].focus()}begin(){const{hello:t}=this.store;if(t===null)return;const e=t.scenes.includes(t.scene)?t.scenes:[t.scene,...t.scenes];this.scene.replaceChildren(...e.map(s=>tt("option",{value:s},Zp(s)))),this.scene.value=t.scene,this.scene.disabled=t.scenes.length<2||!t.mayControl;const n=!this.store.playback;for(const s of[this.trainee,this.main,this.end,this.reset])s.hidden=!n,s.disabled=!t.mayControl,s.title=t.mayControl?"":O.session.watching;document.title=`${Zp(t.scene)} - ${O.title}`,this.show()}show(){const{frame:t,hello:e}=this.store,n=t?.activity??On.Ready,s={[On.Running]:O.session.pause,[On.Paused]:O.session.resume};xn(this.main,s[n]??O.session.start),xn(this.state,e===null?O.link.waiting:O.session.activity[n]??""),this.state.dataset.activity=On[n],xn(this.clock,t===null?"":O.units.s(this.store.seconds(t.tick),1)),this.clear.hidden=!e?.mayControl||!t?.needles.some(o=>o.fault!=="");const r=V_(n);this.trainee.readOnly=r,this.end.disabled=!e?.mayControl||!r}showTabs(){Bi.forEach((t,e)=>{const n=t===this.store.view;this.tabs[e].setAttribute("aria-selected",String(n)),this.tabs[e].tabIndex=n?0:-1})}}const XT=8e3;class YT{constructor(t,e){this.connection=e,this.banner=tt("div",{class:"banner",role:"alert",hidden:!0}),this.notices=tt("div",{class:"notices",role:"status","aria-live":"polite"}),this.words=tt("span"),this.again=$e(O.link.retry,()=>this.act()),this.banner.append(this.words,this.again),t.on(["link"],()=>this.show()),window.setInterval(()=>this.connection().link.state==="waiting"&&this.show(),500)}notice(t){const e=tt("p",{},t);for(this.notices.append(e);this.notices.children.length>3;)this.notices.firstChild?.remove();window.setTimeout(()=>e.remove(),XT)}act(){this.connection().link.state==="closed"?window.location.reload():this.connection().open()}show(){const{link:t}=this.connection(),e=document.body.dataset.seen==="true";t.state==="open"&&(document.body.dataset.seen="true"),document.body.dataset.link=t.state,this.banner.hidden=t.state==="open"||t.state==="connecting"&&!e;const n=(t.retryAt-performance.now())/1e3,s={open:"",connecting:O.link.trying,waiting:O.link.lost(n),closed:O.link.protocol(t.theirs,Jp)}[t.state];xn(this.words,s),xn(this.again,t.state==="closed"?O.link.reload:O.link.retry)}}function qT(){const i=O.help.keys.map(([e,n])=>tt("div",{},tt("dt",{},e),tt("dd",{},n))),t=tt("dialog",{"aria-labelledby":"help-heading"},tt("h2",{id:"help-heading"},O.help.heading),tt("dl",{class:"facts"},...i),$e(O.help.close,()=>t.close(),{class:"primary"}));return t}const le=new HT,ef=new Fg(iA,()=>le.tell("link"),()=>yo.notice(O.link.garbled),i=>_r.view?_r.view.budget.time("message",i):i()),ca=i=>void ef.send(i),Fl=qT(),yo=new YT(le,()=>ef),_r=new VT(le),H_=new WT(le,ca,()=>Fl.showModal()),nf=new bv(le,ca),G_=i=>nf.seek(i),jT=new db(le),W_=new Uv(le,ca,G_),$T=new mv(le,()=>_r.view,()=>W_.drawMs),X_=new Yv(le,ca,G_),ZT=new Wv(le,ca),KT=new qv(le),JT=new jv(le),QT=new Zv(le),tA=tt("div",{class:"side"},...[jT,ZT,W_,X_,KT,JT,$T,QT].map(i=>i.root)),Y_=tt("main",{id:"main",role:"tabpanel"},_r.root,tA);let lh=0;async function eA(){const i=++lh;try{const t=await fetch(im("organ",window.location));if(!t.ok)throw new Error(`HTTP ${t.status}`);const e=tb(await t.arrayBuffer());if(i!==lh||le.hello===null)return;const n=eb(e,le.hello);if(n!=="")throw new Error(n);le.organ=e,le.tell("organ")}catch(t){i===lh&&yo.notice(O.link.organ(t instanceof Error?t.message:""))}}const nA=100;let q_=0;function j_(){q_=performance.now(),le.flush()}function iA(i){i.kind==="refused"&&yo.notice(i.what),le.take(i),performance.now()-q_>nA&&j_(),i.kind==="hello"&&(le.organ=null,eA())}function sA(i){const t=i.target,e=t.matches("input, select, textarea"),n=i.altKey?Bi[Number(i.key)-1]:void 0;if(n!==void 0){i.preventDefault(),le.select(n);return}e||i.altKey||i.ctrlKey||i.metaKey||Fl.open||(i.key==="?"?Fl.showModal():i.key===" "&&!t.matches("button, [role=tab]")?(i.preventDefault(),le.playback?nf.toggle():H_.act()):i.key==="m"&&(i.preventDefault(),le.view!=="teacher"&&le.select("teacher"),X_.input.focus()))}document.title=O.title;document.documentElement.lang=O.language;document.body.append(tt("a",{class:"skip",href:"#scene-canvas"},O.skip),H_.root,yo.banner,Y_,nf.root,yo.notices,Fl);document.addEventListener("keydown",sA);le.on(["view"],()=>{document.body.dataset.view=le.view,window.location.hash.slice(1)!==le.view&&window.history.pushState(null,"",`#${le.view}`),Y_.setAttribute("aria-labelledby",`tab-${le.view}`)});const sf=()=>Bi.find(i=>i===window.location.hash.slice(1))??"trainee";window.addEventListener("popstate",()=>le.select(sf()));window.history.replaceState(null,"",`#${sf()}`);le.select(sf());window.addEventListener("beforeunload",i=>{le.hello?.mayControl&&!le.playback&&V_(le.frame?.activity??On.Ready)&&i.preventDefault()});_r.begin()||yo.notice(O.link.webgl);ef.open();function $_(){requestAnimationFrame($_),j_(),_r.view?.step()}requestAnimationFrame($_);Object.assign(window,{stylet:{store:le,view:()=>_r.view}});
