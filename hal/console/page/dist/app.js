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
*/const Ms=new Int32Array(2),lf=new Float32Array(Ms.buffer),cf=new Float64Array(Ms.buffer),ha=new Uint16Array(new Uint8Array([1,0]).buffer)[0]===1;var Kc;(function(i){i[i.UTF8_BYTES=1]="UTF8_BYTES",i[i.UTF16_STRING=2]="UTF16_STRING"})(Kc||(Kc={}));class so{constructor(t){this.bytes_=t,this.position_=0,this.text_decoder_=new TextDecoder}static allocate(t){return new so(new Uint8Array(t))}clear(){this.position_=0}bytes(){return this.bytes_}position(){return this.position_}setPosition(t){this.position_=t}capacity(){return this.bytes_.length}readInt8(t){return this.readUint8(t)<<24>>24}readUint8(t){return this.bytes_[t]}readInt16(t){return this.readUint16(t)<<16>>16}readUint16(t){return this.bytes_[t]|this.bytes_[t+1]<<8}readInt32(t){return this.bytes_[t]|this.bytes_[t+1]<<8|this.bytes_[t+2]<<16|this.bytes_[t+3]<<24}readUint32(t){return this.readInt32(t)>>>0}readInt64(t){return BigInt.asIntN(64,BigInt(this.readUint32(t))+(BigInt(this.readUint32(t+4))<<BigInt(32)))}readUint64(t){return BigInt.asUintN(64,BigInt(this.readUint32(t))+(BigInt(this.readUint32(t+4))<<BigInt(32)))}readFloat32(t){return Ms[0]=this.readInt32(t),lf[0]}readFloat64(t){return Ms[ha?0:1]=this.readInt32(t),Ms[ha?1:0]=this.readInt32(t+4),cf[0]}writeInt8(t,e){this.bytes_[t]=e}writeUint8(t,e){this.bytes_[t]=e}writeInt16(t,e){this.bytes_[t]=e,this.bytes_[t+1]=e>>8}writeUint16(t,e){this.bytes_[t]=e,this.bytes_[t+1]=e>>8}writeInt32(t,e){this.bytes_[t]=e,this.bytes_[t+1]=e>>8,this.bytes_[t+2]=e>>16,this.bytes_[t+3]=e>>24}writeUint32(t,e){this.bytes_[t]=e,this.bytes_[t+1]=e>>8,this.bytes_[t+2]=e>>16,this.bytes_[t+3]=e>>24}writeInt64(t,e){this.writeInt32(t,Number(BigInt.asIntN(32,e))),this.writeInt32(t+4,Number(BigInt.asIntN(32,e>>BigInt(32))))}writeUint64(t,e){this.writeUint32(t,Number(BigInt.asUintN(32,e))),this.writeUint32(t+4,Number(BigInt.asUintN(32,e>>BigInt(32))))}writeFloat32(t,e){lf[0]=e,this.writeInt32(t,Ms[0])}writeFloat64(t,e){cf[0]=e,this.writeInt32(t,Ms[ha?0:1]),this.writeInt32(t+4,Ms[ha?1:0])}getBufferIdentifier(){if(this.bytes_.length<this.position_+4+4)throw new Error("FlatBuffers: ByteBuffer is too short to contain an identifier.");let t="";for(let e=0;e<4;e++)t+=String.fromCharCode(this.readInt8(this.position_+4+e));return t}__offset(t,e){const n=t-this.readInt32(t);return e<this.readInt16(n)?this.readInt16(n+e):0}__union(t,e){return t.bb_pos=e+this.readInt32(e),t.bb=this,t}__string(t,e){t+=this.readInt32(t);const n=this.readInt32(t);t+=4;const s=this.bytes_.subarray(t,t+n);return e===Kc.UTF8_BYTES?s:this.text_decoder_.decode(s)}__union_with_string(t,e){return typeof t=="string"?this.__string(e):this.__union(t,e)}__indirect(t){return t+this.readInt32(t)}__vector(t){return t+this.readInt32(t)+4}__vector_len(t){return this.readInt32(t+this.readInt32(t))}__has_identifier(t){if(t.length!=4)throw new Error("FlatBuffers: file identifier must be length 4");for(let e=0;e<4;e++)if(t.charCodeAt(e)!=this.readInt8(this.position()+4+e))return!1;return!0}createScalarList(t,e){const n=[];for(let s=0;s<e;++s)t(s)!==null&&n.push(t(s));return n}createObjList(t,e){const n=[];for(let s=0;s<e;++s){const r=t(s);r!==null&&n.push(r.unpack())}return n}}class su{constructor(t){this.minalign=1,this.vtable=null,this.vtable_in_use=0,this.isNested=!1,this.object_start=0,this.vtables=[],this.vector_num_elems=0,this.force_defaults=!1,this.string_maps=null,this.text_encoder=new TextEncoder;let e;t?e=t:e=1024,this.bb=so.allocate(e),this.space=e}clear(){this.bb.clear(),this.space=this.bb.capacity(),this.minalign=1,this.vtable=null,this.vtable_in_use=0,this.isNested=!1,this.object_start=0,this.vtables=[],this.vector_num_elems=0,this.force_defaults=!1,this.string_maps=null}forceDefaults(t){this.force_defaults=t}dataBuffer(){return this.bb}asUint8Array(){return this.bb.bytes().subarray(this.bb.position(),this.bb.position()+this.offset())}prep(t,e){t>this.minalign&&(this.minalign=t);const n=~(this.bb.capacity()-this.space+e)+1&t-1;for(;this.space<n+t+e;){const s=this.bb.capacity();this.bb=su.growByteBuffer(this.bb),this.space+=this.bb.capacity()-s}this.pad(n)}pad(t){for(let e=0;e<t;e++)this.bb.writeInt8(--this.space,0)}writeInt8(t){this.bb.writeInt8(this.space-=1,t)}writeInt16(t){this.bb.writeInt16(this.space-=2,t)}writeInt32(t){this.bb.writeInt32(this.space-=4,t)}writeInt64(t){this.bb.writeInt64(this.space-=8,t)}writeFloat32(t){this.bb.writeFloat32(this.space-=4,t)}writeFloat64(t){this.bb.writeFloat64(this.space-=8,t)}addInt8(t){this.prep(1,0),this.writeInt8(t)}addInt16(t){this.prep(2,0),this.writeInt16(t)}addInt32(t){this.prep(4,0),this.writeInt32(t)}addInt64(t){this.prep(8,0),this.writeInt64(t)}addFloat32(t){this.prep(4,0),this.writeFloat32(t)}addFloat64(t){this.prep(8,0),this.writeFloat64(t)}addFieldInt8(t,e,n){(this.force_defaults||e!=n)&&(this.addInt8(e),this.slot(t))}addFieldInt16(t,e,n){(this.force_defaults||e!=n)&&(this.addInt16(e),this.slot(t))}addFieldInt32(t,e,n){(this.force_defaults||e!=n)&&(this.addInt32(e),this.slot(t))}addFieldInt64(t,e,n){(this.force_defaults||e!==n)&&(this.addInt64(e),this.slot(t))}addFieldFloat32(t,e,n){(this.force_defaults||e!=n)&&(this.addFloat32(e),this.slot(t))}addFieldFloat64(t,e,n){(this.force_defaults||e!=n)&&(this.addFloat64(e),this.slot(t))}addFieldOffset(t,e,n){(this.force_defaults||e!=n)&&(this.addOffset(e),this.slot(t))}addFieldStruct(t,e,n){e!=n&&(this.nested(e),this.slot(t))}nested(t){if(t!=this.offset())throw new Error("FlatBuffers: struct must be serialized inline.")}notNested(){if(this.isNested)throw new Error("FlatBuffers: object serialization must not be nested.")}slot(t){this.vtable!==null&&(this.vtable[t]=this.offset())}offset(){return this.bb.capacity()-this.space}static growByteBuffer(t){const e=t.capacity();if(e&3221225472)throw new Error("FlatBuffers: cannot grow buffer beyond 2 gigabytes.");const n=e<<1,s=so.allocate(n);return s.setPosition(n-e),s.bytes().set(t.bytes(),n-e),s}addOffset(t){this.prep(4,0),this.writeInt32(this.offset()-t+4)}startObject(t){this.notNested(),this.vtable==null&&(this.vtable=[]),this.vtable_in_use=t;for(let e=0;e<t;e++)this.vtable[e]=0;this.isNested=!0,this.object_start=this.offset()}endObject(){if(this.vtable==null||!this.isNested)throw new Error("FlatBuffers: endObject called without startObject");this.addInt32(0);const t=this.offset();let e=this.vtable_in_use-1;for(;e>=0&&this.vtable[e]==0;e--);const n=e+1;for(;e>=0;e--)this.addInt16(this.vtable[e]!=0?t-this.vtable[e]:0);const s=2;this.addInt16(t-this.object_start);const r=(n+s)*2;this.addInt16(r);let o=0;const a=this.space;t:for(e=0;e<this.vtables.length;e++){const l=this.bb.capacity()-this.vtables[e];if(r==this.bb.readInt16(l)){for(let c=2;c<r;c+=2)if(this.bb.readInt16(a+c)!=this.bb.readInt16(l+c))continue t;o=this.vtables[e];break}}return o?(this.space=this.bb.capacity()-t,this.bb.writeInt32(this.space,o-t)):(this.vtables.push(this.offset()),this.bb.writeInt32(this.bb.capacity()-t,this.offset()-t)),this.isNested=!1,t}finish(t,e,n){const s=n?4:0;if(e){const r=e;if(this.prep(this.minalign,8+s),r.length!=4)throw new Error("FlatBuffers: file identifier must be length 4");for(let o=3;o>=0;o--)this.writeInt8(r.charCodeAt(o))}this.prep(this.minalign,4+s),this.addOffset(t),s&&this.addInt32(this.bb.capacity()-this.space),this.bb.setPosition(this.space)}finishSizePrefixed(t,e){this.finish(t,e,!0)}requiredField(t,e){const n=this.bb.capacity()-t,s=n-this.bb.readInt32(n);if(!(this.bb.readInt16(s+e)!=0))throw new Error("FlatBuffers: field "+e+" must be set")}startVector(t,e,n){this.notNested(),this.vector_num_elems=e,this.prep(4,t*e),this.prep(n,t*e)}endVector(){return this.writeInt32(this.vector_num_elems),this.offset()}createSharedString(t){if(!t)return 0;if(this.string_maps||(this.string_maps=new Map),this.string_maps.has(t))return this.string_maps.get(t);const e=this.createString(t);return this.string_maps.set(t,e),e}createString(t){if(t==null)return 0;let e;t instanceof Uint8Array?e=t:e=this.text_encoder.encode(t),this.addInt8(0),this.startVector(1,e.length,1),this.bb.setPosition(this.space-=e.length);for(let n=0,s=this.space,r=this.bb.bytes();n<e.length;n++)r[s++]=e[n];return this.endVector()}createObjectOffset(t){return t===null?0:typeof t=="string"?this.createString(t):t.pack(this)}createObjectOffsetList(t){const e=[];for(let n=0;n<t.length;++n){const s=t[n];if(s!==null)e.push(this.createObjectOffset(s));else throw new Error("FlatBuffers: Argument for createObjectOffsetList cannot contain null.")}return e}createStructOffsetList(t,e){return e(this,t.length),this.createObjectOffsetList(t.slice().reverse()),this.endVector()}}class Ss{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsAcknowledge(t,e){return(e||new Ss).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsAcknowledge(t,e){return t.setPosition(t.position()+4),(e||new Ss).__init(t.readInt32(t.position())+t.position(),t)}needle(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint32(this.bb_pos+t):0}fault(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}static startAcknowledge(t){t.startObject(2)}static addNeedle(t,e){t.addFieldInt32(0,e,0)}static addFault(t,e){t.addFieldOffset(1,e,0)}static endAcknowledge(t){return t.endObject()}static createAcknowledge(t,e,n){return Ss.startAcknowledge(t),Ss.addNeedle(t,e),Ss.addFault(t,n),Ss.endAcknowledge(t)}}var Jc=(i=>(i[i.Ready=0]="Ready",i[i.Running=1]="Running",i[i.Paused=2]="Paused",i[i.Ended=3]="Ended",i[i.Playback=4]="Playback",i))(Jc||{});class Zi{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsAskRows(t,e){return(e||new Zi).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsAskRows(t,e){return t.setPosition(t.position()+4),(e||new Zi).__init(t.readInt32(t.position())+t.position(),t)}first(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}last(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}points(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readUint32(this.bb_pos+t):0}static startAskRows(t){t.startObject(3)}static addFirst(t,e){t.addFieldInt64(0,e,BigInt("0"))}static addLast(t,e){t.addFieldInt64(1,e,BigInt("0"))}static addPoints(t,e){t.addFieldInt32(2,e,0)}static endAskRows(t){return t.endObject()}static createAskRows(t,e,n,s){return Zi.startAskRows(t),Zi.addFirst(t,e),Zi.addLast(t,n),Zi.addPoints(t,s),Zi.endAskRows(t)}}class Zs{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsChoose(t,e){return(e||new Zs).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsChoose(t,e){return t.setPosition(t.position()+4),(e||new Zs).__init(t.readInt32(t.position())+t.position(),t)}scene(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}static startChoose(t){t.startObject(1)}static addScene(t,e){t.addFieldOffset(0,e,0)}static endChoose(t){return t.endObject()}static createChoose(t,e){return Zs.startChoose(t),Zs.addScene(t,e),Zs.endChoose(t)}}class Tp{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}tick(){return this.bb.readUint64(this.bb_pos)}kind(){return this.bb.readUint32(this.bb_pos+8)}needle(){return this.bb.readUint32(this.bb_pos+12)}layer(){return this.bb.readUint32(this.bb_pos+16)}depthM(){return this.bb.readFloat32(this.bb_pos+20)}forceN(){return this.bb.readFloat32(this.bb_pos+24)}static sizeOf(){return 32}static createHappened(t,e,n,s,r,o,a){return t.prep(8,32),t.pad(4),t.writeFloat32(a),t.writeFloat32(o),t.writeInt32(r),t.writeInt32(s),t.writeInt32(n),t.writeInt64(e),t.offset()}}var Qc=(i=>(i[i.Free=0]="Free",i[i.Contact=1]="Contact",i[i.Inserted=2]="Inserted",i[i.Retracting=3]="Retracting",i))(Qc||{});let El=class{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}w(){return this.bb.readFloat32(this.bb_pos)}x(){return this.bb.readFloat32(this.bb_pos+4)}y(){return this.bb.readFloat32(this.bb_pos+8)}z(){return this.bb.readFloat32(this.bb_pos+12)}static sizeOf(){return 16}static createQuaternion(t,e,n,s,r){return t.prep(4,16),t.writeFloat32(r),t.writeFloat32(s),t.writeFloat32(n),t.writeFloat32(e),t.offset()}};class ye{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}x(){return this.bb.readFloat32(this.bb_pos)}y(){return this.bb.readFloat32(this.bb_pos+4)}z(){return this.bb.readFloat32(this.bb_pos+8)}static sizeOf(){return 12}static createVec3(t,e,n,s){return t.prep(4,12),t.writeFloat32(s),t.writeFloat32(n),t.writeFloat32(e),t.offset()}}class nl{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsNeedleFrame(t,e){return(e||new nl).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsNeedleFrame(t,e){return t.setPosition(t.position()+4),(e||new nl).__init(t.readInt32(t.position())+t.position(),t)}nodesM(t,e){const n=this.bb.__offset(this.bb_pos,4);return n?(e||new ye).__init(this.bb.__vector(this.bb_pos+n)+t*12,this.bb):null}nodesMLength(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.__vector_len(this.bb_pos+t):0}handlePositionM(t){const e=this.bb.__offset(this.bb_pos,6);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}handleRotation(t){const e=this.bb.__offset(this.bb_pos,8);return e?(t||new El).__init(this.bb_pos+e,this.bb):null}tipM(t){const e=this.bb.__offset(this.bb_pos,10);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}depthM(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readFloat32(this.bb_pos+t):0}phase(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readUint8(this.bb_pos+t):Qc.Free}layer(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.readUint32(this.bb_pos+t):0}forceN(t){const e=this.bb.__offset(this.bb_pos,18);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}commandN(t){const e=this.bb.__offset(this.bb_pos,20);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}stiffnessN(t){const e=this.bb.__offset(this.bb_pos,22);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}cuttingN(t){const e=this.bb.__offset(this.bb_pos,24);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}frictionN(t){const e=this.bb.__offset(this.bb_pos,26);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}clampingN(t){const e=this.bb.__offset(this.bb_pos,28);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}obstacleN(t){const e=this.bb.__offset(this.bb_pos,30);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}fault(t){const e=this.bb.__offset(this.bb_pos,32);return e?this.bb.__string(this.bb_pos+e,t):null}guard(t){const e=this.bb.__offset(this.bb_pos,34);return e?this.bb.__string(this.bb_pos+e,t):null}flags(){const t=this.bb.__offset(this.bb_pos,36);return t?this.bb.readUint32(this.bb_pos+t):0}static startNeedleFrame(t){t.startObject(17)}static addNodesM(t,e){t.addFieldOffset(0,e,0)}static startNodesMVector(t,e){t.startVector(12,e,4)}static addHandlePositionM(t,e){t.addFieldStruct(1,e,0)}static addHandleRotation(t,e){t.addFieldStruct(2,e,0)}static addTipM(t,e){t.addFieldStruct(3,e,0)}static addDepthM(t,e){t.addFieldFloat32(4,e,0)}static addPhase(t,e){t.addFieldInt8(5,e,Qc.Free)}static addLayer(t,e){t.addFieldInt32(6,e,0)}static addForceN(t,e){t.addFieldStruct(7,e,0)}static addCommandN(t,e){t.addFieldStruct(8,e,0)}static addStiffnessN(t,e){t.addFieldStruct(9,e,0)}static addCuttingN(t,e){t.addFieldStruct(10,e,0)}static addFrictionN(t,e){t.addFieldStruct(11,e,0)}static addClampingN(t,e){t.addFieldStruct(12,e,0)}static addObstacleN(t,e){t.addFieldStruct(13,e,0)}static addFault(t,e){t.addFieldOffset(14,e,0)}static addGuard(t,e){t.addFieldOffset(15,e,0)}static addFlags(t,e){t.addFieldInt32(16,e,0)}static endNeedleFrame(t){return t.endObject()}}class H_{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}positionM(t){return(t||new ye).__init(this.bb_pos,this.bb)}goalM(t){return(t||new ye).__init(this.bb_pos+12,this.bb)}forceN(t){return(t||new ye).__init(this.bb_pos+24,this.bb)}needle(){return this.bb.readUint32(this.bb_pos+36)}static sizeOf(){return 40}static createParticle(t,e,n,s,r,o,a,l,c,h,u){return t.prep(4,40),t.writeInt32(u),t.prep(4,12),t.writeFloat32(h),t.writeFloat32(c),t.writeFloat32(l),t.prep(4,12),t.writeFloat32(a),t.writeFloat32(o),t.writeFloat32(r),t.prep(4,12),t.writeFloat32(s),t.writeFloat32(n),t.writeFloat32(e),t.offset()}}class ru{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}tick(){return this.bb.readUint64(this.bb_pos)}depthM(){return this.bb.readFloat32(this.bb_pos+8)}travelM(){return this.bb.readFloat32(this.bb_pos+12)}forceN(){return this.bb.readFloat32(this.bb_pos+16)}lateralN(){return this.bb.readFloat32(this.bb_pos+20)}stiffnessN(){return this.bb.readFloat32(this.bb_pos+24)}cuttingN(){return this.bb.readFloat32(this.bb_pos+28)}frictionN(){return this.bb.readFloat32(this.bb_pos+32)}clampingN(){return this.bb.readFloat32(this.bb_pos+36)}obstacleN(){return this.bb.readFloat32(this.bb_pos+40)}tickUs(){return this.bb.readFloat32(this.bb_pos+44)}lateUs(){return this.bb.readFloat32(this.bb_pos+48)}needle(){return this.bb.readUint32(this.bb_pos+52)}static sizeOf(){return 56}static createRow(t,e,n,s,r,o,a,l,c,h,u,f,p,_){return t.prep(8,56),t.writeInt32(_),t.writeFloat32(p),t.writeFloat32(f),t.writeFloat32(u),t.writeFloat32(h),t.writeFloat32(c),t.writeFloat32(l),t.writeFloat32(a),t.writeFloat32(o),t.writeFloat32(r),t.writeFloat32(s),t.writeFloat32(n),t.writeInt64(e),t.offset()}}class An{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsTiming(t,e){return(e||new An).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsTiming(t,e){return t.setPosition(t.position()+4),(e||new An).__init(t.readInt32(t.position())+t.position(),t)}ticks(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}missed(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}lostRecords(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}lostFrames(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}connections(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readUint32(this.bb_pos+t):0}tickUs(t){const e=this.bb.__offset(this.bb_pos,14);return e?this.bb.readFloat32(this.bb.__vector(this.bb_pos+e)+t*4):0}tickUsLength(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.__vector_len(this.bb_pos+t):0}tickUsArray(){const t=this.bb.__offset(this.bb_pos,14);return t?new Float32Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}lateUs(t){const e=this.bb.__offset(this.bb_pos,16);return e?this.bb.readFloat32(this.bb.__vector(this.bb_pos+e)+t*4):0}lateUsLength(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.__vector_len(this.bb_pos+t):0}lateUsArray(){const t=this.bb.__offset(this.bb_pos,16);return t?new Float32Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}tickBins(t){const e=this.bb.__offset(this.bb_pos,18);return e?this.bb.readUint32(this.bb.__vector(this.bb_pos+e)+t*4):0}tickBinsLength(){const t=this.bb.__offset(this.bb_pos,18);return t?this.bb.__vector_len(this.bb_pos+t):0}tickBinsArray(){const t=this.bb.__offset(this.bb_pos,18);return t?new Uint32Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}lateBins(t){const e=this.bb.__offset(this.bb_pos,20);return e?this.bb.readUint32(this.bb.__vector(this.bb_pos+e)+t*4):0}lateBinsLength(){const t=this.bb.__offset(this.bb_pos,20);return t?this.bb.__vector_len(this.bb_pos+t):0}lateBinsArray(){const t=this.bb.__offset(this.bb_pos,20);return t?new Uint32Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}binUs(){const t=this.bb.__offset(this.bb_pos,22);return t?this.bb.readFloat32(this.bb_pos+t):0}static startTiming(t){t.startObject(10)}static addTicks(t,e){t.addFieldInt64(0,e,BigInt("0"))}static addMissed(t,e){t.addFieldInt64(1,e,BigInt("0"))}static addLostRecords(t,e){t.addFieldInt64(2,e,BigInt("0"))}static addLostFrames(t,e){t.addFieldInt64(3,e,BigInt("0"))}static addConnections(t,e){t.addFieldInt32(4,e,0)}static addTickUs(t,e){t.addFieldOffset(5,e,0)}static createTickUsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addFloat32(e[n]);return t.endVector()}static startTickUsVector(t,e){t.startVector(4,e,4)}static addLateUs(t,e){t.addFieldOffset(6,e,0)}static createLateUsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addFloat32(e[n]);return t.endVector()}static startLateUsVector(t,e){t.startVector(4,e,4)}static addTickBins(t,e){t.addFieldOffset(7,e,0)}static createTickBinsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addInt32(e[n]);return t.endVector()}static startTickBinsVector(t,e){t.startVector(4,e,4)}static addLateBins(t,e){t.addFieldOffset(8,e,0)}static createLateBinsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addInt32(e[n]);return t.endVector()}static startLateBinsVector(t,e){t.startVector(4,e,4)}static addBinUs(t,e){t.addFieldFloat32(9,e,0)}static endTiming(t){return t.endObject()}static createTiming(t,e,n,s,r,o,a,l,c,h,u){return An.startTiming(t),An.addTicks(t,e),An.addMissed(t,n),An.addLostRecords(t,s),An.addLostFrames(t,r),An.addConnections(t,o),An.addTickUs(t,a),An.addLateUs(t,l),An.addTickBins(t,c),An.addLateBins(t,h),An.addBinUs(t,u),An.endTiming(t)}}class G_{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}positionM(t){return(t||new ye).__init(this.bb_pos,this.bb)}forceN(t){return(t||new ye).__init(this.bb_pos+12,this.bb)}needle(){return this.bb.readUint32(this.bb_pos+24)}static sizeOf(){return 28}static createTouch(t,e,n,s,r,o,a,l){return t.prep(4,28),t.writeInt32(l),t.prep(4,12),t.writeFloat32(a),t.writeFloat32(o),t.writeFloat32(r),t.prep(4,12),t.writeFloat32(s),t.writeFloat32(n),t.writeFloat32(e),t.offset()}}class il{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsFrame(t,e){return(e||new il).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsFrame(t,e){return t.setPosition(t.position()+4),(e||new il).__init(t.readInt32(t.position())+t.position(),t)}tick(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}activity(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.readUint8(this.bb_pos+t):Jc.Ready}key(){const t=this.bb.__offset(this.bb_pos,8);return t?!!this.bb.readInt8(this.bb_pos+t):!1}movedIndex(t){const e=this.bb.__offset(this.bb_pos,10);return e?this.bb.readUint32(this.bb.__vector(this.bb_pos+e)+t*4):0}movedIndexLength(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.__vector_len(this.bb_pos+t):0}movedIndexArray(){const t=this.bb.__offset(this.bb_pos,10);return t?new Uint32Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}movedTo(t){const e=this.bb.__offset(this.bb_pos,12);return e?this.bb.readInt16(this.bb.__vector(this.bb_pos+e)+t*2):0}movedToLength(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.__vector_len(this.bb_pos+t):0}movedToArray(){const t=this.bb.__offset(this.bb_pos,12);return t?new Int16Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}needles(t,e){const n=this.bb.__offset(this.bb_pos,14);return n?(e||new nl).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}needlesLength(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.__vector_len(this.bb_pos+t):0}particles(t,e){const n=this.bb.__offset(this.bb_pos,16);return n?(e||new H_).__init(this.bb.__vector(this.bb_pos+n)+t*40,this.bb):null}particlesLength(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.__vector_len(this.bb_pos+t):0}touches(t,e){const n=this.bb.__offset(this.bb_pos,18);return n?(e||new G_).__init(this.bb.__vector(this.bb_pos+n)+t*28,this.bb):null}touchesLength(){const t=this.bb.__offset(this.bb_pos,18);return t?this.bb.__vector_len(this.bb_pos+t):0}events(t,e){const n=this.bb.__offset(this.bb_pos,20);return n?(e||new Tp).__init(this.bb.__vector(this.bb_pos+n)+t*32,this.bb):null}eventsLength(){const t=this.bb.__offset(this.bb_pos,20);return t?this.bb.__vector_len(this.bb_pos+t):0}rows(t,e){const n=this.bb.__offset(this.bb_pos,22);return n?(e||new ru).__init(this.bb.__vector(this.bb_pos+n)+t*56,this.bb):null}rowsLength(){const t=this.bb.__offset(this.bb_pos,22);return t?this.bb.__vector_len(this.bb_pos+t):0}timing(t){const e=this.bb.__offset(this.bb_pos,24);return e?(t||new An).__init(this.bb.__indirect(this.bb_pos+e),this.bb):null}static startFrame(t){t.startObject(11)}static addTick(t,e){t.addFieldInt64(0,e,BigInt("0"))}static addActivity(t,e){t.addFieldInt8(1,e,Jc.Ready)}static addKey(t,e){t.addFieldInt8(2,+e,0)}static addMovedIndex(t,e){t.addFieldOffset(3,e,0)}static createMovedIndexVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addInt32(e[n]);return t.endVector()}static startMovedIndexVector(t,e){t.startVector(4,e,4)}static addMovedTo(t,e){t.addFieldOffset(4,e,0)}static createMovedToVector(t,e){t.startVector(2,e.length,2);for(let n=e.length-1;n>=0;n--)t.addInt16(e[n]);return t.endVector()}static startMovedToVector(t,e){t.startVector(2,e,2)}static addNeedles(t,e){t.addFieldOffset(5,e,0)}static createNeedlesVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startNeedlesVector(t,e){t.startVector(4,e,4)}static addParticles(t,e){t.addFieldOffset(6,e,0)}static startParticlesVector(t,e){t.startVector(40,e,4)}static addTouches(t,e){t.addFieldOffset(7,e,0)}static startTouchesVector(t,e){t.startVector(28,e,4)}static addEvents(t,e){t.addFieldOffset(8,e,0)}static startEventsVector(t,e){t.startVector(32,e,8)}static addRows(t,e){t.addFieldOffset(9,e,0)}static startRowsVector(t,e){t.startVector(56,e,8)}static addTiming(t,e){t.addFieldOffset(10,e,0)}static endFrame(t){return t.endObject()}}class sl{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsNeedleInfo(t,e){return(e||new sl).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsNeedleInfo(t,e){return t.setPosition(t.position()+4),(e||new sl).__init(t.readInt32(t.position())+t.position(),t)}device(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}lengthM(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.readFloat32(this.bb_pos+t):0}outerRadiusM(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readFloat32(this.bb_pos+t):0}entryM(t){const e=this.bb.__offset(this.bb_pos,10);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}direction(t){const e=this.bb.__offset(this.bb_pos,12);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}maxForceN(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readFloat32(this.bb_pos+t):0}static startNeedleInfo(t){t.startObject(6)}static addDevice(t,e){t.addFieldOffset(0,e,0)}static addLengthM(t,e){t.addFieldFloat32(1,e,0)}static addOuterRadiusM(t,e){t.addFieldFloat32(2,e,0)}static addEntryM(t,e){t.addFieldStruct(3,e,0)}static addDirection(t,e){t.addFieldStruct(4,e,0)}static addMaxForceN(t,e){t.addFieldFloat32(5,e,0)}static endNeedleInfo(t){return t.endObject()}}class rl{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsObstacle(t,e){return(e||new rl).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsObstacle(t,e){return t.setPosition(t.position()+4),(e||new rl).__init(t.readInt32(t.position())+t.position(),t)}positionM(t){const e=this.bb.__offset(this.bb_pos,4);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}rotation(t){const e=this.bb.__offset(this.bb_pos,6);return e?(t||new El).__init(this.bb_pos+e,this.bb):null}verticesM(t,e){const n=this.bb.__offset(this.bb_pos,8);return n?(e||new ye).__init(this.bb.__vector(this.bb_pos+n)+t*12,this.bb):null}verticesMLength(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.__vector_len(this.bb_pos+t):0}roundingM(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.readFloat32(this.bb_pos+t):0}static startObstacle(t){t.startObject(4)}static addPositionM(t,e){t.addFieldStruct(0,e,0)}static addRotation(t,e){t.addFieldStruct(1,e,0)}static addVerticesM(t,e){t.addFieldOffset(2,e,0)}static startVerticesMVector(t,e){t.startVector(12,e,4)}static addRoundingM(t,e){t.addFieldFloat32(3,e,0)}static endObstacle(t){return t.endObject()}}class ol{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsTarget(t,e){return(e||new ol).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsTarget(t,e){return t.setPosition(t.position()+4),(e||new ol).__init(t.readInt32(t.position())+t.position(),t)}name(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}positionM(t){const e=this.bb.__offset(this.bb_pos,6);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}radiusM(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readFloat32(this.bb_pos+t):0}forbidden(){const t=this.bb.__offset(this.bb_pos,10);return t?!!this.bb.readInt8(this.bb_pos+t):!1}static startTarget(t){t.startObject(4)}static addName(t,e){t.addFieldOffset(0,e,0)}static addPositionM(t,e){t.addFieldStruct(1,e,0)}static addRadiusM(t,e){t.addFieldFloat32(2,e,0)}static addForbidden(t,e){t.addFieldInt8(3,+e,0)}static endTarget(t){return t.endObject()}}class Ye{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsHello(t,e){return(e||new Ye).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsHello(t,e){return t.setPosition(t.position()+4),(e||new Ye).__init(t.readInt32(t.position())+t.position(),t)}protocol(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint32(this.bb_pos+t):0}styletVersion(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}scene(t){const e=this.bb.__offset(this.bb_pos,8);return e?this.bb.__string(this.bb_pos+e,t):null}scenes(t,e){const n=this.bb.__offset(this.bb_pos,10);return n?this.bb.__string(this.bb.__vector(this.bb_pos+n)+t*4,e):null}scenesLength(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.__vector_len(this.bb_pos+t):0}periodS(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readFloat32(this.bb_pos+t):0}recordingTicks(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}voxelEdgeM(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.readFloat32(this.bb_pos+t):0}particles(){const t=this.bb.__offset(this.bb_pos,18);return t?this.bb.readUint32(this.bb_pos+t):0}restM(t,e){const n=this.bb.__offset(this.bb_pos,20);return n?(e||new ye).__init(this.bb.__vector(this.bb_pos+n)+t*12,this.bb):null}restMLength(){const t=this.bb.__offset(this.bb_pos,20);return t?this.bb.__vector_len(this.bb_pos+t):0}corners(t){const e=this.bb.__offset(this.bb_pos,22);return e?this.bb.readUint32(this.bb.__vector(this.bb_pos+e)+t*4):0}cornersLength(){const t=this.bb.__offset(this.bb_pos,22);return t?this.bb.__vector_len(this.bb_pos+t):0}cornersArray(){const t=this.bb.__offset(this.bb_pos,22);return t?new Uint32Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}positionUnitM(){const t=this.bb.__offset(this.bb_pos,24);return t?this.bb.readFloat32(this.bb_pos+t):0}needles(t,e){const n=this.bb.__offset(this.bb_pos,26);return n?(e||new sl).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}needlesLength(){const t=this.bb.__offset(this.bb_pos,26);return t?this.bb.__vector_len(this.bb_pos+t):0}obstacles(t,e){const n=this.bb.__offset(this.bb_pos,28);return n?(e||new rl).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}obstaclesLength(){const t=this.bb.__offset(this.bb_pos,28);return t?this.bb.__vector_len(this.bb_pos+t):0}targets(t,e){const n=this.bb.__offset(this.bb_pos,30);return n?(e||new ol).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}targetsLength(){const t=this.bb.__offset(this.bb_pos,30);return t?this.bb.__vector_len(this.bb_pos+t):0}mayControl(){const t=this.bb.__offset(this.bb_pos,32);return t?!!this.bb.readInt8(this.bb_pos+t):!1}static startHello(t){t.startObject(15)}static addProtocol(t,e){t.addFieldInt32(0,e,0)}static addStyletVersion(t,e){t.addFieldOffset(1,e,0)}static addScene(t,e){t.addFieldOffset(2,e,0)}static addScenes(t,e){t.addFieldOffset(3,e,0)}static createScenesVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startScenesVector(t,e){t.startVector(4,e,4)}static addPeriodS(t,e){t.addFieldFloat32(4,e,0)}static addRecordingTicks(t,e){t.addFieldInt64(5,e,BigInt("0"))}static addVoxelEdgeM(t,e){t.addFieldFloat32(6,e,0)}static addParticles(t,e){t.addFieldInt32(7,e,0)}static addRestM(t,e){t.addFieldOffset(8,e,0)}static startRestMVector(t,e){t.startVector(12,e,4)}static addCorners(t,e){t.addFieldOffset(9,e,0)}static createCornersVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addInt32(e[n]);return t.endVector()}static startCornersVector(t,e){t.startVector(4,e,4)}static addPositionUnitM(t,e){t.addFieldFloat32(10,e,0)}static addNeedles(t,e){t.addFieldOffset(11,e,0)}static createNeedlesVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startNeedlesVector(t,e){t.startVector(4,e,4)}static addObstacles(t,e){t.addFieldOffset(12,e,0)}static createObstaclesVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startObstaclesVector(t,e){t.startVector(4,e,4)}static addTargets(t,e){t.addFieldOffset(13,e,0)}static createTargetsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startTargetsVector(t,e){t.startVector(4,e,4)}static addMayControl(t,e){t.addFieldInt8(14,+e,0)}static endHello(t){return t.endObject()}static createHello(t,e,n,s,r,o,a,l,c,h,u,f,p,_,b,m){return Ye.startHello(t),Ye.addProtocol(t,e),Ye.addStyletVersion(t,n),Ye.addScene(t,s),Ye.addScenes(t,r),Ye.addPeriodS(t,o),Ye.addRecordingTicks(t,a),Ye.addVoxelEdgeM(t,l),Ye.addParticles(t,c),Ye.addRestM(t,h),Ye.addCorners(t,u),Ye.addPositionUnitM(t,f),Ye.addNeedles(t,p),Ye.addObstacles(t,_),Ye.addTargets(t,b),Ye.addMayControl(t,m),Ye.endHello(t)}}class Ks{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsMark(t,e){return(e||new Ks).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsMark(t,e){return t.setPosition(t.position()+4),(e||new Ks).__init(t.readInt32(t.position())+t.position(),t)}text(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}static startMark(t){t.startObject(1)}static addText(t,e){t.addFieldOffset(0,e,0)}static endMark(t){return t.endObject()}static createMark(t,e){return Ks.startMark(t),Ks.addText(t,e),Ks.endMark(t)}}class ys{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsMarked(t,e){return(e||new ys).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsMarked(t,e){return t.setPosition(t.position()+4),(e||new ys).__init(t.readInt32(t.position())+t.position(),t)}tick(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}text(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}static startMarked(t){t.startObject(2)}static addTick(t,e){t.addFieldInt64(0,e,BigInt("0"))}static addText(t,e){t.addFieldOffset(1,e,0)}static endMarked(t){return t.endObject()}static createMarked(t,e,n){return ys.startMarked(t),ys.addTick(t,e),ys.addText(t,n),ys.endMarked(t)}}class Yr{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsPause(t,e){return(e||new Yr).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsPause(t,e){return t.setPosition(t.position()+4),(e||new Yr).__init(t.readInt32(t.position())+t.position(),t)}static startPause(t){t.startObject(0)}static endPause(t){return t.endObject()}static createPause(t){return Yr.startPause(t),Yr.endPause(t)}}class Js{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsPlay(t,e){return(e||new Js).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsPlay(t,e){return t.setPosition(t.position()+4),(e||new Js).__init(t.readInt32(t.position())+t.position(),t)}speed(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readFloat32(this.bb_pos+t):0}static startPlay(t){t.startObject(1)}static addSpeed(t,e){t.addFieldFloat32(0,e,0)}static endPlay(t){return t.endObject()}static createPlay(t,e){return Js.startPlay(t),Js.addSpeed(t,e),Js.endPlay(t)}}class Qi{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsPointer(t,e){return(e||new Qi).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsPointer(t,e){return t.setPosition(t.position()+4),(e||new Qi).__init(t.readInt32(t.position())+t.position(),t)}needle(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint32(this.bb_pos+t):0}positionM(t){const e=this.bb.__offset(this.bb_pos,6);return e?(t||new ye).__init(this.bb_pos+e,this.bb):null}rotation(t){const e=this.bb.__offset(this.bb_pos,8);return e?(t||new El).__init(this.bb_pos+e,this.bb):null}buttons(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.readUint32(this.bb_pos+t):0}static startPointer(t){t.startObject(4)}static addNeedle(t,e){t.addFieldInt32(0,e,0)}static addPositionM(t,e){t.addFieldStruct(1,e,0)}static addRotation(t,e){t.addFieldStruct(2,e,0)}static addButtons(t,e){t.addFieldInt32(3,e,0)}static endPointer(t){return t.endObject()}}class Qs{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsRefused(t,e){return(e||new Qs).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsRefused(t,e){return t.setPosition(t.position()+4),(e||new Qs).__init(t.readInt32(t.position())+t.position(),t)}what(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}static startRefused(t){t.startObject(1)}static addWhat(t,e){t.addFieldOffset(0,e,0)}static endRefused(t){return t.endObject()}static createRefused(t,e){return Qs.startRefused(t),Qs.addWhat(t,e),Qs.endRefused(t)}}class qr{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsReset(t,e){return(e||new qr).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsReset(t,e){return t.setPosition(t.position()+4),(e||new qr).__init(t.readInt32(t.position())+t.position(),t)}static startReset(t){t.startObject(0)}static endReset(t){return t.endObject()}static createReset(t){return qr.startReset(t),qr.endReset(t)}}class jr{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsResume(t,e){return(e||new jr).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsResume(t,e){return t.setPosition(t.position()+4),(e||new jr).__init(t.readInt32(t.position())+t.position(),t)}static startResume(t){t.startObject(0)}static endResume(t){return t.endObject()}static createResume(t){return jr.startResume(t),jr.endResume(t)}}class Di{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsRows(t,e){return(e||new Di).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsRows(t,e){return t.setPosition(t.position()+4),(e||new Di).__init(t.readInt32(t.position())+t.position(),t)}first(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}stride(){const t=this.bb.__offset(this.bb_pos,6);return t?this.bb.readUint32(this.bb_pos+t):0}rows(t,e){const n=this.bb.__offset(this.bb_pos,8);return n?(e||new ru).__init(this.bb.__vector(this.bb_pos+n)+t*56,this.bb):null}rowsLength(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.__vector_len(this.bb_pos+t):0}events(t,e){const n=this.bb.__offset(this.bb_pos,10);return n?(e||new Tp).__init(this.bb.__vector(this.bb_pos+n)+t*32,this.bb):null}eventsLength(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.__vector_len(this.bb_pos+t):0}static startRows(t){t.startObject(4)}static addFirst(t,e){t.addFieldInt64(0,e,BigInt("0"))}static addStride(t,e){t.addFieldInt32(1,e,0)}static addRows(t,e){t.addFieldOffset(2,e,0)}static startRowsVector(t,e){t.startVector(56,e,8)}static addEvents(t,e){t.addFieldOffset(3,e,0)}static startEventsVector(t,e){t.startVector(32,e,8)}static endRows(t){return t.endObject()}static createRows(t,e,n,s,r){return Di.startRows(t),Di.addFirst(t,e),Di.addStride(t,n),Di.addRows(t,s),Di.addEvents(t,r),Di.endRows(t)}}class Ki{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsPunctureScore(t,e){return(e||new Ki).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsPunctureScore(t,e){return t.setPosition(t.position()+4),(e||new Ki).__init(t.readInt32(t.position())+t.position(),t)}tick(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}layer(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}forceN(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readFloat32(this.bb_pos+t):0}static startPunctureScore(t){t.startObject(3)}static addTick(t,e){t.addFieldInt64(0,e,BigInt("0"))}static addLayer(t,e){t.addFieldOffset(1,e,0)}static addForceN(t,e){t.addFieldFloat32(2,e,0)}static endPunctureScore(t){return t.endObject()}static createPunctureScore(t,e,n,s){return Ki.startPunctureScore(t),Ki.addTick(t,e),Ki.addLayer(t,n),Ki.addForceN(t,s),Ki.endPunctureScore(t)}}class Ui{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsTargetScore(t,e){return(e||new Ui).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsTargetScore(t,e){return t.setPosition(t.position()+4),(e||new Ui).__init(t.readInt32(t.position())+t.position(),t)}name(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}forbidden(){const t=this.bb.__offset(this.bb_pos,6);return t?!!this.bb.readInt8(this.bb_pos+t):!1}closestM(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readFloat32(this.bb_pos+t):0}reached(){const t=this.bb.__offset(this.bb_pos,10);return t?!!this.bb.readInt8(this.bb_pos+t):!1}static startTargetScore(t){t.startObject(4)}static addName(t,e){t.addFieldOffset(0,e,0)}static addForbidden(t,e){t.addFieldInt8(1,+e,0)}static addClosestM(t,e){t.addFieldFloat32(2,e,0)}static addReached(t,e){t.addFieldInt8(3,+e,0)}static endTargetScore(t){return t.endObject()}static createTargetScore(t,e,n,s,r){return Ui.startTargetScore(t),Ui.addName(t,e),Ui.addForbidden(t,n),Ui.addClosestM(t,s),Ui.addReached(t,r),Ui.endTargetScore(t)}}class Ge{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsScore(t,e){return(e||new Ge).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsScore(t,e){return t.setPosition(t.position()+4),(e||new Ge).__init(t.readInt32(t.position())+t.position(),t)}attempt(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint32(this.bb_pos+t):0}scene(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}trainee(t){const e=this.bb.__offset(this.bb_pos,8);return e?this.bb.__string(this.bb_pos+e,t):null}began(t){const e=this.bb.__offset(this.bb_pos,10);return e?this.bb.__string(this.bb_pos+e,t):null}durationS(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readFloat32(this.bb_pos+t):0}pathM(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readFloat32(this.bb_pos+t):0}depthPathM(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.readFloat32(this.bb_pos+t):0}punctures(t,e){const n=this.bb.__offset(this.bb_pos,18);return n?(e||new Ki).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}puncturesLength(){const t=this.bb.__offset(this.bb_pos,18);return t?this.bb.__vector_len(this.bb_pos+t):0}withdrawals(){const t=this.bb.__offset(this.bb_pos,20);return t?this.bb.readUint32(this.bb_pos+t):0}targets(t,e){const n=this.bb.__offset(this.bb_pos,22);return n?(e||new Ui).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}targetsLength(){const t=this.bb.__offset(this.bb_pos,22);return t?this.bb.__vector_len(this.bb_pos+t):0}peakForceN(){const t=this.bb.__offset(this.bb_pos,24);return t?this.bb.readFloat32(this.bb_pos+t):0}peakLateralN(){const t=this.bb.__offset(this.bb_pos,26);return t?this.bb.readFloat32(this.bb_pos+t):0}meanForceN(){const t=this.bb.__offset(this.bb_pos,28);return t?this.bb.readFloat32(this.bb_pos+t):0}faults(){const t=this.bb.__offset(this.bb_pos,30);return t?this.bb.readUint32(this.bb_pos+t):0}recording(t){const e=this.bb.__offset(this.bb_pos,32);return e?this.bb.__string(this.bb_pos+e,t):null}rows(t,e){const n=this.bb.__offset(this.bb_pos,34);return n?(e||new ru).__init(this.bb.__vector(this.bb_pos+n)+t*56,this.bb):null}rowsLength(){const t=this.bb.__offset(this.bb_pos,34);return t?this.bb.__vector_len(this.bb_pos+t):0}static startScore(t){t.startObject(16)}static addAttempt(t,e){t.addFieldInt32(0,e,0)}static addScene(t,e){t.addFieldOffset(1,e,0)}static addTrainee(t,e){t.addFieldOffset(2,e,0)}static addBegan(t,e){t.addFieldOffset(3,e,0)}static addDurationS(t,e){t.addFieldFloat32(4,e,0)}static addPathM(t,e){t.addFieldFloat32(5,e,0)}static addDepthPathM(t,e){t.addFieldFloat32(6,e,0)}static addPunctures(t,e){t.addFieldOffset(7,e,0)}static createPuncturesVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startPuncturesVector(t,e){t.startVector(4,e,4)}static addWithdrawals(t,e){t.addFieldInt32(8,e,0)}static addTargets(t,e){t.addFieldOffset(9,e,0)}static createTargetsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startTargetsVector(t,e){t.startVector(4,e,4)}static addPeakForceN(t,e){t.addFieldFloat32(10,e,0)}static addPeakLateralN(t,e){t.addFieldFloat32(11,e,0)}static addMeanForceN(t,e){t.addFieldFloat32(12,e,0)}static addFaults(t,e){t.addFieldInt32(13,e,0)}static addRecording(t,e){t.addFieldOffset(14,e,0)}static addRows(t,e){t.addFieldOffset(15,e,0)}static startRowsVector(t,e){t.startVector(56,e,8)}static endScore(t){return t.endObject()}static createScore(t,e,n,s,r,o,a,l,c,h,u,f,p,_,b,m,d){return Ge.startScore(t),Ge.addAttempt(t,e),Ge.addScene(t,n),Ge.addTrainee(t,s),Ge.addBegan(t,r),Ge.addDurationS(t,o),Ge.addPathM(t,a),Ge.addDepthPathM(t,l),Ge.addPunctures(t,c),Ge.addWithdrawals(t,h),Ge.addTargets(t,u),Ge.addPeakForceN(t,f),Ge.addPeakLateralN(t,p),Ge.addMeanForceN(t,_),Ge.addFaults(t,b),Ge.addRecording(t,m),Ge.addRows(t,d),Ge.endScore(t)}}class tr{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsSeek(t,e){return(e||new tr).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsSeek(t,e){return t.setPosition(t.position()+4),(e||new tr).__init(t.readInt32(t.position())+t.position(),t)}tick(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint64(this.bb_pos+t):BigInt("0")}static startSeek(t){t.startObject(1)}static addTick(t,e){t.addFieldInt64(0,e,BigInt("0"))}static endSeek(t){return t.endObject()}static createSeek(t,e){return tr.startSeek(t),tr.addTick(t,e),tr.endSeek(t)}}class er{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsStart(t,e){return(e||new er).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsStart(t,e){return t.setPosition(t.position()+4),(e||new er).__init(t.readInt32(t.position())+t.position(),t)}trainee(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}static startStart(t){t.startObject(1)}static addTrainee(t,e){t.addFieldOffset(0,e,0)}static endStart(t){return t.endObject()}static createStart(t,e){return er.startStart(t),er.addTrainee(t,e),er.endStart(t)}}var $e=(i=>(i[i.NONE=0]="NONE",i[i.Hello=1]="Hello",i[i.Frame=2]="Frame",i[i.Rows=3]="Rows",i[i.Score=4]="Score",i[i.Marked=5]="Marked",i[i.Refused=6]="Refused",i[i.Start=7]="Start",i[i.Pause=8]="Pause",i[i.Resume=9]="Resume",i[i.Reset=10]="Reset",i[i.Choose=11]="Choose",i[i.Seek=12]="Seek",i[i.Play=13]="Play",i[i.AskRows=14]="AskRows",i[i.Mark=15]="Mark",i[i.Pointer=16]="Pointer",i[i.Acknowledge=17]="Acknowledge",i))($e||{});class ts{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsMessage(t,e){return(e||new ts).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsMessage(t,e){return t.setPosition(t.position()+4),(e||new ts).__init(t.readInt32(t.position())+t.position(),t)}static bufferHasIdentifier(t){return t.__has_identifier("STLC")}bodyType(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint8(this.bb_pos+t):$e.NONE}body(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__union(t,this.bb_pos+e):null}static startMessage(t){t.startObject(2)}static addBodyType(t,e){t.addFieldInt8(0,e,$e.NONE)}static addBody(t,e){t.addFieldOffset(1,e,0)}static endMessage(t){return t.endObject()}static finishMessageBuffer(t,e){t.finish(e,"STLC")}static finishSizePrefixedMessageBuffer(t,e){t.finish(e,"STLC",!0)}static createMessage(t,e,n){return ts.startMessage(t),ts.addBodyType(t,e),ts.addBody(t,n),ts.endMessage(t)}}const Ap=1,Rp="STLC";var Kn=(i=>(i[i.Ready=0]="Ready",i[i.Running=1]="Running",i[i.Paused=2]="Paused",i[i.Ended=3]="Ended",i[i.Playback=4]="Playback",i))(Kn||{});const W_=4294967295,th=["stiffness","cutting","friction","clamping","obstacle"],X_={x:0,y:0,z:0},Y_={w:1,x:0,y:0,z:0},Ze=i=>i?{x:i.x(),y:i.y(),z:i.z()}:X_,Pp=i=>i?{w:i.w(),x:i.x(),y:i.y(),z:i.z()}:Y_,Nn=i=>typeof i=="string"?i:"";let eh=0;function Cp(i){if(eh-=i,i<0||eh<0)throw new RangeError("more elements than bytes")}function Pn(i,t,e){Cp(i);const n=[];for(let s=0;s<i;++s){const r=t(s);r!==null&&n.push(e(r))}return n}function q_(i){return{device:Nn(i.device()),length:i.lengthM(),outerRadius:i.outerRadiusM(),entry:Ze(i.entryM()),direction:Ze(i.direction()),maxForce:i.maxForceN()}}function j_(i){return{position:Ze(i.positionM()),rotation:Pp(i.rotation()),vertices:Pn(i.verticesMLength(),t=>i.verticesM(t),Ze),rounding:i.roundingM()}}function $_(i){Cp(i.restMLength());const t=new Float32Array(3*i.restMLength()),e=new ye;for(let n=0;3*n<t.length;++n)i.restM(n,e),t[3*n]=e.x(),t[3*n+1]=e.y(),t[3*n+2]=e.z();return t}function Z_(i){return{kind:"hello",protocol:i.protocol(),version:Nn(i.styletVersion()),scene:Nn(i.scene()),scenes:Pn(i.scenesLength(),t=>i.scenes(t),Nn),period:i.periodS(),recordingTicks:Number(i.recordingTicks()),voxelEdge:i.voxelEdgeM(),particles:i.particles(),rest:$_(i),corners:(i.cornersArray()??new Uint32Array).slice(),positionUnit:i.positionUnitM(),needles:Pn(i.needlesLength(),t=>i.needles(t),q_),obstacles:Pn(i.obstaclesLength(),t=>i.obstacles(t),j_),targets:Pn(i.targetsLength(),t=>i.targets(t),t=>({name:Nn(t.name()),position:Ze(t.positionM()),radius:t.radiusM(),forbidden:t.forbidden()})),mayControl:i.mayControl()}}function K_(i){return{nodes:Pn(i.nodesMLength(),t=>i.nodesM(t),Ze),handle:Ze(i.handlePositionM()),handleRotation:Pp(i.handleRotation()),tip:Ze(i.tipM()),depth:i.depthM(),phase:i.phase(),layer:i.layer(),force:Ze(i.forceN()),command:Ze(i.commandN()),causes:{stiffness:Ze(i.stiffnessN()),cutting:Ze(i.cuttingN()),friction:Ze(i.frictionN()),clamping:Ze(i.clampingN()),obstacle:Ze(i.obstacleN())},fault:Nn(i.fault()),guard:Nn(i.guard()),flags:i.flags()}}function ou(i){return{tick:Number(i.tick()),depth:i.depthM(),travel:i.travelM(),force:i.forceN(),lateral:i.lateralN(),stiffness:i.stiffnessN(),cutting:i.cuttingN(),friction:i.frictionN(),clamping:i.clampingN(),obstacle:i.obstacleN(),tickUs:i.tickUs(),lateUs:i.lateUs(),needle:i.needle()}}const Lp=i=>({tick:Number(i.tick()),eventKind:i.kind(),needle:i.needle(),layer:i.layer(),depth:i.depthM(),force:i.forceN()});function J_(i){return i===null?null:{ticks:Number(i.ticks()),missed:Number(i.missed()),lostRecords:Number(i.lostRecords()),lostFrames:Number(i.lostFrames()),connections:i.connections(),tickUs:i.tickUsArray()??new Float32Array,lateUs:i.lateUsArray()??new Float32Array,tickBins:i.tickBinsArray()??new Uint32Array,lateBins:i.lateBinsArray()??new Uint32Array,binUs:i.binUs()}}function Q_(i){return{kind:"frame",tick:Number(i.tick()),activity:i.activity(),key:i.key(),movedIndex:i.movedIndexArray()??new Uint32Array,movedTo:i.movedToArray()??new Int16Array,needles:Pn(i.needlesLength(),t=>i.needles(t),K_),particles:Pn(i.particlesLength(),t=>i.particles(t),t=>({position:Ze(t.positionM(new ye)),goal:Ze(t.goalM(new ye)),force:Ze(t.forceN(new ye)),needle:t.needle()})),touches:Pn(i.touchesLength(),t=>i.touches(t),t=>({position:Ze(t.positionM(new ye)),force:Ze(t.forceN(new ye)),needle:t.needle()})),events:Pn(i.eventsLength(),t=>i.events(t),Lp),rows:Pn(i.rowsLength(),t=>i.rows(t),ou),timing:J_(i.timing())}}function tg(i){return{kind:"score",attempt:i.attempt(),scene:Nn(i.scene()),trainee:Nn(i.trainee()),began:Nn(i.began()),duration:i.durationS(),path:i.pathM(),depthPath:i.depthPathM(),punctures:Pn(i.puncturesLength(),t=>i.punctures(t),t=>({tick:Number(t.tick()),layer:Nn(t.layer()),force:t.forceN()})),withdrawals:i.withdrawals(),targets:Pn(i.targetsLength(),t=>i.targets(t),t=>({name:Nn(t.name()),forbidden:t.forbidden(),closest:t.closestM(),reached:t.reached()})),peakForce:i.peakForceN(),peakLateral:i.peakLateralN(),meanForce:i.meanForceN(),faults:i.faults(),recording:Nn(i.recording()),rows:Pn(i.rowsLength(),t=>i.rows(t),ou)}}const eg=i=>({kind:"rows",first:Number(i.first()),stride:i.stride(),rows:Pn(i.rowsLength(),t=>i.rows(t),ou),events:Pn(i.eventsLength(),t=>i.events(t),Lp)});function ng(i){try{const t=new so(new Uint8Array(i));if(eh=i.byteLength/4,i.byteLength<12||!t.__has_identifier(Rp))return null;const e=ts.getRootAsMessage(t),n=s=>e.body(s);switch(e.bodyType()){case $e.Hello:return Z_(n(new Ye));case $e.Frame:return Q_(n(new il));case $e.Rows:return eg(n(new Di));case $e.Score:return tg(n(new Ge));case $e.Marked:{const s=n(new ys);return{kind:"marked",tick:Number(s.tick()),text:Nn(s.text())}}case $e.Refused:return{kind:"refused",what:Nn(n(new Qs).what())};default:return null}}catch{return null}}function pi(i,t){const e=new su(128),n=t(e),s=ts.createMessage(e,i,n);return e.finish(s,Rp),e.asUint8Array()}const li={start:i=>pi($e.Start,t=>er.createStart(t,t.createString(i))),pause:()=>pi($e.Pause,i=>Yr.createPause(i)),resume:()=>pi($e.Resume,i=>jr.createResume(i)),reset:()=>pi($e.Reset,i=>qr.createReset(i)),choose:i=>pi($e.Choose,t=>Zs.createChoose(t,t.createString(i))),seek:i=>pi($e.Seek,t=>tr.createSeek(t,BigInt(Math.max(0,Math.round(i))))),play:i=>pi($e.Play,t=>Js.createPlay(t,i)),rows:(i,t,e)=>pi($e.AskRows,n=>Zi.createAskRows(n,BigInt(i),BigInt(t),e)),mark:i=>pi($e.Mark,t=>Ks.createMark(t,t.createString(i))),pointer:(i,t,e,n)=>pi($e.Pointer,s=>(Qi.startPointer(s),Qi.addNeedle(s,i),Qi.addPositionM(s,ye.createVec3(s,t.x,t.y,t.z)),Qi.addRotation(s,El.createQuaternion(s,e.w,e.x,e.y,e.z)),Qi.addButtons(s,n),Qi.endPointer(s))),acknowledge:(i,t)=>pi($e.Acknowledge,e=>Ss.createAcknowledge(e,i,e.createString(t)))},ig=500,sg=1e4,rg=65536;function Ip(i,t){const e=new URL(i,t.href),n=new URLSearchParams(t.search).get("token");return e.search=n===null?"":`?${new URLSearchParams({token:n}).toString()}`,e}function og(i,t){return Math.min(sg,ig*2**Math.max(0,i-1))*(.5+.5*t)}class ag{constructor(t,e,n,s){this.heard=t,this.changed=e,this.garbled=n,this.timed=s,this.link={state:"connecting",retryAt:0,theirs:0},this.socket=null,this.failures=0,this.timer=0}open(){window.clearTimeout(this.timer),this.socket?.close();const t=Ip("ws",window.location);t.protocol=t.protocol==="https:"?"wss:":"ws:";const e=new WebSocket(t);e.binaryType="arraybuffer",this.socket=e,this.enter("connecting"),e.onopen=()=>this.enter("open"),e.onmessage=n=>{e===this.socket&&this.timed(()=>this.take(n.data))},e.onclose=()=>e===this.socket&&this.lost()}send(t){const e=this.socket;return e===null||e.readyState!==WebSocket.OPEN||e.bufferedAmount>rg?!1:(e.send(t),!0)}take(t){const e=t instanceof ArrayBuffer?ng(t):null;if(e===null){this.garbled();return}if(e.kind==="hello"){if(e.protocol!==Ap){this.link.theirs=e.protocol;const n=this.socket;this.socket=null,n?.close(),this.enter("closed");return}this.failures=0}this.heard(e)}lost(){this.socket=null,++this.failures;const t=og(this.failures,Math.random());this.link.retryAt=performance.now()+t,this.timer=window.setTimeout(()=>this.open(),t),this.enter("waiting")}enter(t){this.link.state=t,this.changed()}}function tt(i,t={},...e){const n=document.createElement(i);for(const[s,r]of Object.entries(t))typeof r=="function"?n.addEventListener(s.slice(2),r):r===!0?n.setAttribute(s,""):r!==!1&&n.setAttribute(s,String(r));return n.append(...e),n}function Sn(i,t){i.textContent!==t&&(i.textContent=t)}function Je(i,t,e={}){return tt("button",{type:"button",onclick:t,...e},i)}function nh(i,t){const e=Je(i,()=>au(e,e.getAttribute("aria-pressed")!=="true",t),{"aria-pressed":"false",class:"toggle"});return e}function au(i,t,e){i.setAttribute("aria-pressed",String(t)),e?.(t)}let lg=0;function qo(i,t){return t.id||=`field-${++lg}`,tt("div",{class:"field"},tt("label",{for:t.id},i),t)}function Is(i,t,e,...n){const s=`${i}-heading`;return tt("section",{class:`panel ${i}`,"data-in":e,"aria-labelledby":s},tt("h2",{id:s},t),...n)}function al(i,t,e=""){const n=tt("table");return e!==""&&n.append(tt("caption",{},e)),n.append(tt("thead",{},tt("tr",{},...i.map(s=>tt("th",{scope:"col"},s))))),n.append(tt("tbody",{},...t.map(([s,...r])=>tt("tr",{},tt("th",{scope:"row"},s),...r.map(o=>tt("td",{},o)))))),n}function ec(i,t,e){const n=URL.createObjectURL(new Blob([e],{type:t}));tt("a",{href:n,download:i}).click(),window.setTimeout(()=>URL.revokeObjectURL(n),1e3)}const cr=()=>matchMedia("(prefers-color-scheme: dark)").matches,cg=()=>matchMedia("(prefers-reduced-motion: reduce)").matches;function Fp(i,t){let e=!1,n=-1/0;return()=>{if(e)return;e=!0;const s=Math.max(0,i-(performance.now()-n));window.setTimeout(()=>{e=!1,n=performance.now(),t()},s)}}let hg=class Xe{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsMaterial(t,e){return(e||new Xe).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsMaterial(t,e){return t.setPosition(t.position()+4),(e||new Xe).__init(t.readInt32(t.position())+t.position(),t)}name(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}source(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}densityKgPerM3(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readFloat32(this.bb_pos+t):0}youngsModulusPa(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.readFloat32(this.bb_pos+t):0}poissonRatio(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readFloat32(this.bb_pos+t):0}relaxingFraction(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readFloat32(this.bb_pos+t):0}relaxationTimeS(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.readFloat32(this.bb_pos+t):0}punctureForceN(){const t=this.bb.__offset(this.bb_pos,18);return t?this.bb.readFloat32(this.bb_pos+t):0}cuttingForceN(){const t=this.bb.__offset(this.bb_pos,20);return t?this.bb.readFloat32(this.bb_pos+t):0}recutFraction(){const t=this.bb.__offset(this.bb_pos,22);return t?this.bb.readFloat32(this.bb_pos+t):0}coulombFrictionNPerM(){const t=this.bb.__offset(this.bb_pos,24);return t?this.bb.readFloat32(this.bb_pos+t):0}staticFrictionNPerM(){const t=this.bb.__offset(this.bb_pos,26);return t?this.bb.readFloat32(this.bb_pos+t):0}stribeckVelocityMPerS(){const t=this.bb.__offset(this.bb_pos,28);return t?this.bb.readFloat32(this.bb_pos+t):0}viscousFrictionNSPerM2(){const t=this.bb.__offset(this.bb_pos,30);return t?this.bb.readFloat32(this.bb_pos+t):0}punctureVelocityExponent(){const t=this.bb.__offset(this.bb_pos,32);return t?this.bb.readFloat32(this.bb_pos+t):0}membraneNPerM(){const t=this.bb.__offset(this.bb_pos,34);return t?this.bb.readFloat32(this.bb_pos+t):0}static startMaterial(t){t.startObject(16)}static addName(t,e){t.addFieldOffset(0,e,0)}static addSource(t,e){t.addFieldOffset(1,e,0)}static addDensityKgPerM3(t,e){t.addFieldFloat32(2,e,0)}static addYoungsModulusPa(t,e){t.addFieldFloat32(3,e,0)}static addPoissonRatio(t,e){t.addFieldFloat32(4,e,0)}static addRelaxingFraction(t,e){t.addFieldFloat32(5,e,0)}static addRelaxationTimeS(t,e){t.addFieldFloat32(6,e,0)}static addPunctureForceN(t,e){t.addFieldFloat32(7,e,0)}static addCuttingForceN(t,e){t.addFieldFloat32(8,e,0)}static addRecutFraction(t,e){t.addFieldFloat32(9,e,0)}static addCoulombFrictionNPerM(t,e){t.addFieldFloat32(10,e,0)}static addStaticFrictionNPerM(t,e){t.addFieldFloat32(11,e,0)}static addStribeckVelocityMPerS(t,e){t.addFieldFloat32(12,e,0)}static addViscousFrictionNSPerM2(t,e){t.addFieldFloat32(13,e,0)}static addPunctureVelocityExponent(t,e){t.addFieldFloat32(14,e,0)}static addMembraneNPerM(t,e){t.addFieldFloat32(15,e,0)}static endMaterial(t){const e=t.endObject();return t.requiredField(e,4),e}static createMaterial(t,e,n,s,r,o,a,l,c,h,u,f,p,_,b,m,d){return Xe.startMaterial(t),Xe.addName(t,e),Xe.addSource(t,n),Xe.addDensityKgPerM3(t,s),Xe.addYoungsModulusPa(t,r),Xe.addPoissonRatio(t,o),Xe.addRelaxingFraction(t,a),Xe.addRelaxationTimeS(t,l),Xe.addPunctureForceN(t,c),Xe.addCuttingForceN(t,h),Xe.addRecutFraction(t,u),Xe.addCoulombFrictionNPerM(t,f),Xe.addStaticFrictionNPerM(t,p),Xe.addStribeckVelocityMPerS(t,_),Xe.addViscousFrictionNSPerM2(t,b),Xe.addPunctureVelocityExponent(t,m),Xe.addMembraneNPerM(t,d),Xe.endMaterial(t)}},ug=class bi{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsSource(t,e){return(e||new bi).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsSource(t,e){return t.setPosition(t.position()+4),(e||new bi).__init(t.readInt32(t.position())+t.position(),t)}path(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}tissue(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}sha256(t){const e=this.bb.__offset(this.bb_pos,8);return e?this.bb.__string(this.bb_pos+e,t):null}metresPerUnit(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.readFloat64(this.bb_pos+t):0}priority(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readInt32(this.bb_pos+t):0}triangleCount(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readUint32(this.bb_pos+t):0}static startSource(t){t.startObject(6)}static addPath(t,e){t.addFieldOffset(0,e,0)}static addTissue(t,e){t.addFieldOffset(1,e,0)}static addSha256(t,e){t.addFieldOffset(2,e,0)}static addMetresPerUnit(t,e){t.addFieldFloat64(3,e,0)}static addPriority(t,e){t.addFieldInt32(4,e,0)}static addTriangleCount(t,e){t.addFieldInt32(5,e,0)}static endSource(t){return t.endObject()}static createSource(t,e,n,s,r,o,a){return bi.startSource(t),bi.addPath(t,e),bi.addTissue(t,n),bi.addSha256(t,s),bi.addMetresPerUnit(t,r),bi.addPriority(t,o),bi.addTriangleCount(t,a),bi.endSource(t)}};class Ji{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsProvenance(t,e){return(e||new Ji).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsProvenance(t,e){return t.setPosition(t.position()+4),(e||new Ji).__init(t.readInt32(t.position())+t.position(),t)}toolVersion(t){const e=this.bb.__offset(this.bb_pos,4);return e?this.bb.__string(this.bb_pos+e,t):null}options(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}sources(t,e){const n=this.bb.__offset(this.bb_pos,8);return n?(e||new ug).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}sourcesLength(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.__vector_len(this.bb_pos+t):0}static startProvenance(t){t.startObject(3)}static addToolVersion(t,e){t.addFieldOffset(0,e,0)}static addOptions(t,e){t.addFieldOffset(1,e,0)}static addSources(t,e){t.addFieldOffset(2,e,0)}static createSourcesVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startSourcesVector(t,e){t.startVector(4,e,4)}static endProvenance(t){return t.endObject()}static createProvenance(t,e,n,s){return Ji.startProvenance(t),Ji.addToolVersion(t,e),Ji.addOptions(t,n),Ji.addSources(t,s),Ji.endProvenance(t)}}class Dp{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}x(){return this.bb.readUint16(this.bb_pos)}y(){return this.bb.readUint16(this.bb_pos+2)}z(){return this.bb.readUint16(this.bb_pos+4)}count(){return this.bb.readUint16(this.bb_pos+6)}static sizeOf(){return 8}static createRun(t,e,n,s,r){return t.prep(2,8),t.writeInt16(r),t.writeInt16(s),t.writeInt16(n),t.writeInt16(e),t.offset()}}class fg{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}x(){return this.bb.readFloat32(this.bb_pos)}y(){return this.bb.readFloat32(this.bb_pos+4)}z(){return this.bb.readFloat32(this.bb_pos+8)}radius(){return this.bb.readFloat32(this.bb_pos+12)}first(){return this.bb.readUint32(this.bb_pos+16)}count(){return this.bb.readUint32(this.bb_pos+20)}static sizeOf(){return 24}static createSphereNode(t,e,n,s,r,o,a){return t.prep(4,24),t.writeInt32(a),t.writeInt32(o),t.writeFloat32(r),t.writeFloat32(s),t.writeFloat32(n),t.writeFloat32(e),t.offset()}}let Up=class{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}a(){return this.bb.readUint32(this.bb_pos)}b(){return this.bb.readUint32(this.bb_pos+4)}c(){return this.bb.readUint32(this.bb_pos+8)}static sizeOf(){return 12}static createTriangle(t,e,n,s){return t.prep(4,12),t.writeInt32(s),t.writeInt32(n),t.writeInt32(e),t.offset()}};class Np{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}voxel(){return this.bb.readUint32(this.bb_pos)}fx(){return this.bb.readUint16(this.bb_pos+4)}fy(){return this.bb.readUint16(this.bb_pos+6)}fz(){return this.bb.readUint16(this.bb_pos+8)}reserved(){return this.bb.readUint16(this.bb_pos+10)}static sizeOf(){return 12}static createVertex(t,e,n,s,r,o){return t.prep(4,12),t.writeInt16(o),t.writeInt16(r),t.writeInt16(s),t.writeInt16(n),t.writeInt32(e),t.offset()}}class ll{constructor(){this.bb=null,this.bb_pos=0}__init(t,e){return this.bb_pos=t,this.bb=e,this}static getRootAsOrgan(t,e){return(e||new ll).__init(t.readInt32(t.position())+t.position(),t)}static getSizePrefixedRootAsOrgan(t,e){return t.setPosition(t.position()+4),(e||new ll).__init(t.readInt32(t.position())+t.position(),t)}static bufferHasIdentifier(t){return t.__has_identifier("STLO")}formatVersion(){const t=this.bb.__offset(this.bb_pos,4);return t?this.bb.readUint32(this.bb_pos+t):0}name(t){const e=this.bb.__offset(this.bb_pos,6);return e?this.bb.__string(this.bb_pos+e,t):null}voxelEdgeM(){const t=this.bb.__offset(this.bb_pos,8);return t?this.bb.readFloat32(this.bb_pos+t):0}originXM(){const t=this.bb.__offset(this.bb_pos,10);return t?this.bb.readFloat32(this.bb_pos+t):0}originYM(){const t=this.bb.__offset(this.bb_pos,12);return t?this.bb.readFloat32(this.bb_pos+t):0}originZM(){const t=this.bb.__offset(this.bb_pos,14);return t?this.bb.readFloat32(this.bb_pos+t):0}sizeX(){const t=this.bb.__offset(this.bb_pos,16);return t?this.bb.readUint16(this.bb_pos+t):0}sizeY(){const t=this.bb.__offset(this.bb_pos,18);return t?this.bb.readUint16(this.bb_pos+t):0}sizeZ(){const t=this.bb.__offset(this.bb_pos,20);return t?this.bb.readUint16(this.bb_pos+t):0}runs(t,e){const n=this.bb.__offset(this.bb_pos,22);return n?(e||new Dp).__init(this.bb.__vector(this.bb_pos+n)+t*8,this.bb):null}runsLength(){const t=this.bb.__offset(this.bb_pos,22);return t?this.bb.__vector_len(this.bb_pos+t):0}voxelMaterial(t){const e=this.bb.__offset(this.bb_pos,24);return e?this.bb.readUint8(this.bb.__vector(this.bb_pos+e)+t):0}voxelMaterialLength(){const t=this.bb.__offset(this.bb_pos,24);return t?this.bb.__vector_len(this.bb_pos+t):0}voxelMaterialArray(){const t=this.bb.__offset(this.bb_pos,24);return t?new Uint8Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}voxelFill(t){const e=this.bb.__offset(this.bb_pos,26);return e?this.bb.readUint8(this.bb.__vector(this.bb_pos+e)+t):0}voxelFillLength(){const t=this.bb.__offset(this.bb_pos,26);return t?this.bb.__vector_len(this.bb_pos+t):0}voxelFillArray(){const t=this.bb.__offset(this.bb_pos,26);return t?new Uint8Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}voxelFixed(t){const e=this.bb.__offset(this.bb_pos,28);return e?this.bb.readUint8(this.bb.__vector(this.bb_pos+e)+t):0}voxelFixedLength(){const t=this.bb.__offset(this.bb_pos,28);return t?this.bb.__vector_len(this.bb_pos+t):0}voxelFixedArray(){const t=this.bb.__offset(this.bb_pos,28);return t?new Uint8Array(this.bb.bytes().buffer,this.bb.bytes().byteOffset+this.bb.__vector(this.bb_pos+t),this.bb.__vector_len(this.bb_pos+t)):null}materials(t,e){const n=this.bb.__offset(this.bb_pos,30);return n?(e||new hg).__init(this.bb.__indirect(this.bb.__vector(this.bb_pos+n)+t*4),this.bb):null}materialsLength(){const t=this.bb.__offset(this.bb_pos,30);return t?this.bb.__vector_len(this.bb_pos+t):0}vertices(t,e){const n=this.bb.__offset(this.bb_pos,32);return n?(e||new Np).__init(this.bb.__vector(this.bb_pos+n)+t*12,this.bb):null}verticesLength(){const t=this.bb.__offset(this.bb_pos,32);return t?this.bb.__vector_len(this.bb_pos+t):0}triangles(t,e){const n=this.bb.__offset(this.bb_pos,34);return n?(e||new Up).__init(this.bb.__vector(this.bb_pos+n)+t*12,this.bb):null}trianglesLength(){const t=this.bb.__offset(this.bb_pos,34);return t?this.bb.__vector_len(this.bb_pos+t):0}sphereNodes(t,e){const n=this.bb.__offset(this.bb_pos,36);return n?(e||new fg).__init(this.bb.__vector(this.bb_pos+n)+t*24,this.bb):null}sphereNodesLength(){const t=this.bb.__offset(this.bb_pos,36);return t?this.bb.__vector_len(this.bb_pos+t):0}provenance(t){const e=this.bb.__offset(this.bb_pos,38);return e?(t||new Ji).__init(this.bb.__indirect(this.bb_pos+e),this.bb):null}static startOrgan(t){t.startObject(18)}static addFormatVersion(t,e){t.addFieldInt32(0,e,0)}static addName(t,e){t.addFieldOffset(1,e,0)}static addVoxelEdgeM(t,e){t.addFieldFloat32(2,e,0)}static addOriginXM(t,e){t.addFieldFloat32(3,e,0)}static addOriginYM(t,e){t.addFieldFloat32(4,e,0)}static addOriginZM(t,e){t.addFieldFloat32(5,e,0)}static addSizeX(t,e){t.addFieldInt16(6,e,0)}static addSizeY(t,e){t.addFieldInt16(7,e,0)}static addSizeZ(t,e){t.addFieldInt16(8,e,0)}static addRuns(t,e){t.addFieldOffset(9,e,0)}static startRunsVector(t,e){t.startVector(8,e,2)}static addVoxelMaterial(t,e){t.addFieldOffset(10,e,0)}static createVoxelMaterialVector(t,e){t.startVector(1,e.length,1);for(let n=e.length-1;n>=0;n--)t.addInt8(e[n]);return t.endVector()}static startVoxelMaterialVector(t,e){t.startVector(1,e,1)}static addVoxelFill(t,e){t.addFieldOffset(11,e,0)}static createVoxelFillVector(t,e){t.startVector(1,e.length,1);for(let n=e.length-1;n>=0;n--)t.addInt8(e[n]);return t.endVector()}static startVoxelFillVector(t,e){t.startVector(1,e,1)}static addVoxelFixed(t,e){t.addFieldOffset(12,e,0)}static createVoxelFixedVector(t,e){t.startVector(1,e.length,1);for(let n=e.length-1;n>=0;n--)t.addInt8(e[n]);return t.endVector()}static startVoxelFixedVector(t,e){t.startVector(1,e,1)}static addMaterials(t,e){t.addFieldOffset(13,e,0)}static createMaterialsVector(t,e){t.startVector(4,e.length,4);for(let n=e.length-1;n>=0;n--)t.addOffset(e[n]);return t.endVector()}static startMaterialsVector(t,e){t.startVector(4,e,4)}static addVertices(t,e){t.addFieldOffset(14,e,0)}static startVerticesVector(t,e){t.startVector(12,e,4)}static addTriangles(t,e){t.addFieldOffset(15,e,0)}static startTrianglesVector(t,e){t.startVector(12,e,4)}static addSphereNodes(t,e){t.addFieldOffset(16,e,0)}static startSphereNodesVector(t,e){t.startVector(24,e,4)}static addProvenance(t,e){t.addFieldOffset(17,e,0)}static endOrgan(t){const e=t.endObject();return t.requiredField(e,22),t.requiredField(e,24),t.requiredField(e,26),t.requiredField(e,30),e}static finishOrganBuffer(t,e){t.finish(e,"STLO")}static finishSizePrefixedOrganBuffer(t,e){t.finish(e,"STLO",!0)}}const dg="STLO",pg=65535;class lu extends Error{}function mg(i){const t=[],e=new Dp;for(let n=0;n<i.runsLength();++n){i.runs(n,e);const[s,r,o,a]=[e.x(),e.y(),e.z(),e.count()];for(let l=0;l<a;++l)t.push(s+l,r,o)}return Uint16Array.from(t)}function _g(i,t){const e=[i.originXM(),i.originYM(),i.originZM()],n=new Np;for(let s=0;s<i.verticesLength();++s){i.vertices(s,n);const r=n.voxel();if(r>=t.voxelCount)throw new lu(`vertex ${s}: voxel ${r}`);t.vertexVoxel[s]=r,[n.fx(),n.fy(),n.fz()].forEach((o,a)=>{const l=o/pg;t.vertexFraction[3*s+a]=l,t.vertexRest[3*s+a]=e[a]+(t.voxelPlace[3*r+a]+l)*t.edge})}}function gg(i,t){const e=new Up,n=i.verticesLength();for(let s=0;s<i.trianglesLength();++s)i.triangles(s,e),[e.a(),e.b(),e.c()].forEach((r,o)=>{if(r>=n)throw new lu(`triangle ${s}: vertex ${r}`);t.triangles[3*s+o]=r})}function bg(i,t){const e=new Float32Array(i.length);for(let n=0;n<t.length;n+=3){const[s,r,o]=[3*t[n],3*t[n+1],3*t[n+2]],[a,l,c]=[0,1,2].map(_=>i[r+_]-i[s+_]),[h,u,f]=[0,1,2].map(_=>i[o+_]-i[s+_]),p=[l*f-c*u,c*h-a*f,a*u-l*h];for(const _ of[s,r,o])for(let b=0;b<3;++b)e[_+b]+=p[b]}for(let n=0;n<e.length;n+=3){const s=Math.hypot(e[n],e[n+1],e[n+2])||1;for(let r=0;r<3;++r)e[n+r]/=s}return e}function vg(i){const t=new so(new Uint8Array(i));if(i.byteLength<12||!t.__has_identifier(dg))throw new lu("no organ file");const e=ll.getRootAsOrgan(t),n=mg(e),s={name:e.name()??"",edge:e.voxelEdgeM(),voxelCount:n.length/3,voxelPlace:n,voxelMaterial:(e.voxelMaterialArray()??new Uint8Array).slice(),materials:[],vertexVoxel:new Uint32Array(e.verticesLength()),vertexFraction:new Float32Array(3*e.verticesLength()),vertexRest:new Float32Array(3*e.verticesLength()),vertexNormal:new Float32Array,triangles:new Uint32Array(3*e.trianglesLength())};for(let r=0;r<e.materialsLength();++r)s.materials.push(e.materials(r)?.name()??`${r}`);return _g(e,s),gg(e,s),s.vertexNormal=bg(s.vertexRest,s.triangles),s}function xg(i,t){if(t.corners.length!==8*i.voxelCount)return`corners of ${t.corners.length/8} voxels, organ of ${i.voxelCount}`;if(t.rest.length!==3*t.particles)return`${t.rest.length/3} places of ${t.particles} particles`;const e=t.corners.find(n=>n>=t.particles);return e===void 0?"":`corner ${e} of ${t.particles} particles`}function Mg(i,t){const e=(a,l,c)=>a+65537*(l+65537*c),n=new Set;for(let a=0;a<i.voxelCount;++a){const[l,c,h]=i.voxelPlace.subarray(3*a,3*a+3);n.add(e(l+1,c+1,h+1))}const s=new Set,r=[],o=(a,l)=>{const c=Math.min(a,l)*67108864+Math.max(a,l);s.has(c)||(s.add(c),r.push(a,l))};for(let a=0;a<i.voxelCount;++a){const[l,c,h]=i.voxelPlace.subarray(3*a,3*a+3);for(let u=0;u<3;++u)for(const f of[0,1]){const p=[0,0,0];if(p[u]=f===1?1:-1,n.has(e(l+1+p[0],c+1+p[1],h+1+p[2])))continue;const _=1<<u,[b,m]=[1<<(u+1)%3,1<<(u+2)%3],d=S=>t[8*a+S+(f===1?_:0)];o(d(0),d(b)),o(d(0),d(m)),o(d(b),d(b+m)),o(d(m),d(b+m))}}return Uint32Array.from(r)}const cl={stiffness:{colour:"#0072b2",dark:"#56b4e9",dash:[]},cutting:{colour:"#c24e00",dark:"#ff8c42",dash:[8,3]},friction:{colour:"#009e73",dark:"#1f9e7a",dash:[2,3]},clamping:{colour:"#a8478a",dark:"#d85fb0",dash:[10,3,2,3]},obstacle:{colour:"#5c3d00",dark:"#f5e6a8",dash:[4,4]}},hf=["#cc6677","#ddcc77","#88ccee","#44aa99","#999933","#aa4499","#117733","#332288","#882255"],Op=i=>hf[i%hf.length],on={needle:"#a9b4c2",handle:"#6f7b8a",lattice:"#b3261e",particle:"#2fa84f",goal:"#f0e442",obstacle:"#9aa3ad",target:"#0072b2",forbidden:"#d55e00",force:"#e69f00",inside:"#7c3b47"},cu={colour:"#1d2733",dark:"#f2f5f8",dash:[]},hl={colour:"#6b7785",dark:"#93a0ae",dash:[5,3]},kp={colour:"#0072b2",dark:"#56b4e9",dash:[]},Bp={colour:"#c24e00",dark:"#ff8c42",dash:[7,3]},Sg=[cu,hl,kp,Bp,...Object.values(cl)],yg=(i,t)=>t?i.dark:i.colour,wg=i=>Sg.find(t=>t.dark===i)?.colour??i,$r=["tick","depth","travel","force","lateral","stiffness","cutting","friction","clamping","obstacle","tickUs","lateUs"];class zp{constructor(){this.length=0,this.columns=$r.map(()=>new Float64Array(4096))}clear(){this.length=0}column(t){return this.columns[$r.indexOf(t)].subarray(0,this.length)}find(t){const e=this.columns[0];let n=0,s=this.length;for(;n<s;){const r=n+s>>1;e[r]<t?n=r+1:s=r}return n}add(t){const e=this.find(t.tick);e<this.length&&this.columns[0][e]===t.tick||this.open(e),$r.forEach((s,r)=>this.columns[r][e]=t[s])}near(t){if(this.length===0)return null;let e=Math.min(this.find(t),this.length-1);const n=this.columns[0];e>0&&t-n[e-1]<n[e]-t&&--e;const s=$r.map((r,o)=>[r,this.columns[o][e]]);return Object.fromEntries(s)}open(t){if(this.length===this.columns[0].length&&(this.columns=this.columns.map(e=>{const n=new Float64Array(2*e.length);return n.set(e),n})),t<this.length)for(const e of this.columns)e.copyWithin(t+1,t,this.length);++this.length}}function Vp(i,t,e,n){const s=e-t;if(s<=4*n)return Array.from({length:Math.max(0,s)},(o,a)=>t+a);const r=[];for(let o=0;o<n;++o){const a=t+Math.floor(o*s/n),l=t+Math.floor((o+1)*s/n);let[c,h]=[a,a];for(let f=a;f<l;++f)i[f]<i[c]&&(c=f),i[f]>i[h]&&(h=f);const u=[a,Math.min(c,h),Math.max(c,h),l-1];for(const f of u)r[r.length-1]!==f&&r.push(f)}return r}function Wr(i){for(let t=1;t<9;++t){const e=i.toPrecision(t);if(Math.fround(Number(e))===Math.fround(i))return String(Number(e))}return String(Number(i.toPrecision(9)))}const Eg=i=>`${Math.round(100*i)} %`,k={title:"Stylet console",brand:"Stylet",skip:"Skip to the 3D view",views:{trainee:"Trainee",teacher:"Teacher",engineer:"Engineer",report:"Report"},viewsLabel:"Views",language:"en",link:{connecting:"Connecting",open:"Connected",lost:i=>`Connection lost: nothing here is live. Next try in ${Math.max(0,Math.ceil(i))} s.`,trying:"Connection lost: nothing here is live. Trying again now.",retry:"Try now",protocol:(i,t)=>`The program speaks protocol ${i}, this page ${t}. Load the page again from the program that runs.`,reload:"Load again",garbled:"A message of the program could not be read, and was left out.",organ:i=>`The organ could not be shown: ${i}.`,webgl:"This browser offers no WebGL 2: there are plots, but no 3D view.",waiting:"Waiting for the program"},session:{label:"Session",scene:"Scene",trainee:"Trainee",traineeHint:"Name or number",start:"Start",pause:"Pause",resume:"Resume",reset:"Reset",acknowledge:"Acknowledge fault",activity:["Ready","Running","Paused","Ended","Recording"],watching:"Watching only: this connection may not control the session."},view3d:{label:"3D view",canvas:"3D view of organ and needle. Arrow keys turn, plus and minus go nearer and away, 1 to 5 choose a point of view.",toolbar:"What the 3D view shows",presets:{side:"Side",oblique:"Oblique",behind:"Behind the needle",above:"Above",tip:"Tip"},presetsLabel:"Point of view",surface:"Surface",xray:"X-ray",lattice:"Lattice",particles:"Particles",cut:"Cut open",cutAt:"Place of the cut",frameRate:i=>i>0?`${i} fps`:"at rest",frameRateLabel:"Pictures drawn in the last second",legendParticle:"Constraint particle",legendGoal:"Its goal",legendLattice:"Voxel lattice",legendTarget:"Target",legendForbidden:"Forbidden zone",legendForce:"Force on the hand",legend:"Legend"},force:{heading:"Force",onHand:"Force on the hand",gauge:(i,t)=>`${i.toFixed(2)} of at most ${t.toFixed(1)} newtons`,depth:"Depth in tissue",phase:"Phase",layer:"Tissue at the tip",outside:"outside",phases:["Free","Contact","Inserted","Retracting"],atCursor:"At the cursor, as recorded",now:"Now",tick:"Tick",time:"Time",vector:"Force x, y, z",axial:"Along the needle",lateral:"Across",needle:"Needle",needleNumber:i=>`Needle ${i+1}`,causes:{stiffness:"Surface",cutting:"Cutting",friction:"Friction",clamping:"Clamping",obstacle:"Obstacle"},total:"Sum",fault:i=>`Fault: ${i}`},plots:{time:"Force against time",depth:"Force against depth",timeAxis:"Time in s",depthAxis:"Depth in mm",forceAxis:"Force in N",byCause:"By cause",whole:"Whole attempt",window:"Last 20 s",exportLabel:i=>`Save: ${i}`,png:"PNG",svg:"SVG",csv:"CSV",empty:"No ticks yet",description:(i,t,e)=>`${i}: ${t} values, at most ${e.toFixed(2)} N in magnitude.`,keyboard:"Left and right arrows move the cursor.",events:["Contact","Release","Puncture","Re-entry","Exit","Layer","Obstacle"],mark:"Mark",legend:"Curves"},loop:{heading:"Loop",tick:"Time of a tick",late:"Lateness",ticksAxis:"Ticks",usAxis:"us",quantile:"Quantile",quantiles:["50 %","90 %","99 %","99.9 %","largest"],counts:{ticks:"Ticks",missed:"Missed ticks",lostRecords:"Records lost",lostFrames:"Frames lost here",connections:"Connections"},page:"This page",parts:{message:"Read a frame",upload:"Upload",bodies:"Needle and particles",draw:"Draw",plots:"Plots"},ms:i=>`${i.toFixed(1)} ms`,guard:"Guard",command:"Force sent to the device",flags:"Flags",flagNames:["input not finite","input clamped","input missing","particle pool full","voxel pool full","contact budget","obstacle pool full","needle unstable"],kernelFault:"kernel fault",none:"none",particles:"Constraint particles",voxels:(i,t)=>`${i.toLocaleString("en")} voxels, ${t.toLocaleString("en")} triangles`},playback:{heading:"Recording",position:"Place in the recording",play:"Play",hold:"Hold",back:"One tick back",forward:"One tick on",speed:"Speed",speedOf:i=>i===1?"as recorded":`${i} x`,at:(i,t)=>`${i} of ${t} s`,nextEvent:"Next event",lastEvent:"Previous event"},marks:{heading:"Marks",label:"Note at this moment",hint:"What you saw",add:"Mark",none:"No marks yet.",goTo:(i,t)=>`${i} s: ${t}`},scores:{heading:"Score card",none:"The score card is filled when an attempt ends.",attempt:i=>`Attempt ${i}`,lines:{trainee:"Trainee",began:"Began",duration:"Time",path:"Way of the tip",depthPath:"of it in tissue",punctures:"Punctures",withdrawals:"Withdrawals",targets:"Targets reached",forbidden:"Forbidden zones touched",closest:"Closest to a target",peakForce:"Peak force",peakLateral:"Peak force across",meanForce:"Mean force in tissue",faults:"Faults of the guard",recording:"Recording"},of:(i,t)=>`${i} of ${t}`,puncture:(i,t)=>`${i} at ${t}`,notKept:"not kept",dash:"-"},compare:{heading:"Comparison",first:"First",second:"Second",difference:"Difference",what:"Quantity",need:"Two finished attempts can be compared here.",plot:"Force against depth, two attempts"},report:{heading:"Session report",print:"Print",made:i=>`Made ${i}`,version:i=>`stylet ${i}`,attempts:"Attempts",curves:"Force against time",marks:"Teacher's marks",targets:"Targets and zones",none:"No attempt was finished in this session.",target:"Target",kind:"Kind",kinds:{target:"target",forbidden:"forbidden zone"},closest:"Closest",reached:"Reached",yes:"yes",no:"no",signature:"Signature of the teacher"},pointer:{heading:"Needle by pointer",hold:"Hold the needle",letGo:"Let go",help:"Drag up to push and down to pull, sideways to move aside, wheel to roll. Keys: W and S push and pull, A and D aside, R and F up and down, Q and E roll; Shift is slow.",pad:"Needle: drag up to push, down to pull; keys W S A D R F Q E",advance:i=>`Advance ${i.toFixed(1)} mm`,roll:i=>`Roll ${i.toFixed(0)} deg`,home:"Back to the start"},help:{open:"Keys",heading:"Keys",close:"Close",keys:[["Tab, Shift+Tab","next and previous control"],["Alt+1 to Alt+4","trainee, teacher, engineer, report"],["Space","start, pause, resume; in a recording play and hold"],["M","write a mark"],["Arrows","in the 3D view: turn; in a plot or on the scrub bar: move the cursor"],["+ and -","in the 3D view: nearer, away"],["1 to 5","in the 3D view: side, oblique, behind, above, tip"],["X, L, P, C","in the 3D view: x-ray, lattice, particles, cut"],["W S A D R F Q E","on the needle pad: push, pull, aside, up, down, roll"],["?","these keys"]]},units:{n:(i,t=2)=>`${i.toFixed(t)} N`,mm:(i,t=1)=>`${(1e3*i).toFixed(t)} mm`,s:(i,t=1)=>`${i.toFixed(t)} s`,us:i=>`${i.toFixed(0)} us`,percent:Eg}},uf=i=>Math.hypot(i.x,i.y,i.z);class Tg{constructor(t){this.store=t,this.big=tt("output",{class:"big"}),this.bar=tt("div",{class:"bar-fill"}),this.meter=tt("div",{class:"bar",role:"meter","aria-label":k.force.onHand},this.bar),this.facts=tt("dl",{class:"facts"}),this.causes=tt("ul",{class:"causes"}),this.fault=tt("p",{class:"fault",role:"alert",hidden:!0}),this.choice=tt("select"),this.choiceField=qo(k.force.needle,this.choice),this.cells=new Map;const e=tt("dl",{class:"facts exact","data-in":"teacher engineer"});this.addFacts(this.facts,["depth","phase","layer"]),this.addFacts(e,["tick","time","vector","axial","lateral"]);for(const n of th)this.causes.append(this.causeBar(n));this.causes.dataset.in="engineer",this.root=Is("force",k.force.heading,"trainee teacher engineer",this.choiceField,tt("div",{class:"gauge"},this.big,this.meter),this.fault,this.facts,this.causes,e),this.choice.addEventListener("change",()=>{t.needle=Number(this.choice.value),t.tell("needle")}),t.on(["hello"],()=>this.begin()),t.on(["frame","needle","rows","organ"],()=>this.show())}addFacts(t,e){for(const n of e){const s=tt("dd",{"data-value":n});this.cells.set(n,s),t.append(tt("div",{},tt("dt",{},k.force[n]),s))}}causeBar(t){const e=tt("span",{class:"cause-value"}),n=tt("span",{class:"cause-fill"});return n.style.setProperty("--light",cl[t].colour),n.style.setProperty("--dark",cl[t].dark),this.cells.set(t,e),this.cells.set(`${t}-fill`,n),tt("li",{},tt("span",{},k.force.causes[t]),tt("span",{class:"cause-bar"},n),e)}begin(){const t=this.store.hello?.needles??[];this.choice.replaceChildren(...t.map((e,n)=>tt("option",{value:n},k.force.needleNumber(n)))),this.choice.value=String(this.store.needle),this.choiceField.hidden=t.length<2}show(){const{frame:t,hello:e,needle:n}=this.store,s=t?.needles[n],r=e?.needles[n];if(!t||!s||!r)return;const o=r.maxForce>0?r.maxForce:10,a=uf(s.force);Sn(this.big,k.units.n(a));const l=Math.min(1,a/o);this.bar.style.transform=`scaleX(${l.toFixed(4)})`,this.meter.dataset.level=l>.9?"high":l>.6?"raised":"low",this.meter.setAttribute("aria-valuemin","0"),this.meter.setAttribute("aria-valuemax",o.toFixed(1)),this.meter.setAttribute("aria-valuenow",a.toFixed(2)),this.meter.setAttribute("aria-valuetext",k.force.gauge(a,o)),Sn(this.fault,s.fault===""?"":k.force.fault(s.fault)),this.fault.hidden=s.fault==="",this.showFacts(s,o)}put(t,e){const n=this.cells.get(t);n&&Sn(n,e)}showFacts(t,e){const{frame:n,hello:s,needle:r}=this.store,o=s?.needles[r]?.direction;if(!n||!o)return;this.put("depth",k.units.mm(t.depth)),this.put("phase",k.force.phases[t.phase]??""),this.put("layer",t.layer===W_?k.force.outside:this.store.layerName(t.layer)),this.put("tick",String(n.tick)),this.put("time",k.units.s(this.store.seconds(n.tick),3));const{x:a,y:l,z:c}=t.force;this.put("vector",`${Wr(a)}, ${Wr(l)}, ${Wr(c)} N`);const h=p=>p.x*o.x+p.y*o.y+p.z*o.z,u=this.store.rows.near(n.tick),f=u!==null&&u.tick===n.tick;this.put("axial",f?`${Wr(u.force)} N`:k.units.n(-h(t.force),3)),this.put("lateral",f?`${Wr(u.lateral)} N`:k.scores.dash);for(const p of th){const _=uf(t.causes[p]);this.put(p,k.units.n(_));const b=this.cells.get(`${p}-fill`);b&&(b.style.transform=`scaleX(${Math.min(1,_/e).toFixed(4)})`)}}}const Ag=!0,un="u-",Rg="uplot",Pg=un+"hz",Cg=un+"vt",Lg=un+"title",Ig=un+"wrap",Fg=un+"under",Dg=un+"over",Ug=un+"axis",nr=un+"off",Ng=un+"select",Og=un+"cursor-x",kg=un+"cursor-y",Bg=un+"cursor-pt",zg=un+"legend",Vg=un+"live",Hg=un+"inline",Gg=un+"series",Wg=un+"marker",ff=un+"label",Xg=un+"value",Bo="width",zo="height",Ro="top",df="bottom",Rr="left",nc="right",hu="#000",pf=hu+"0",ic="mousemove",mf="mousedown",sc="mouseup",_f="mouseenter",gf="mouseleave",bf="dblclick",Yg="resize",qg="scroll",vf="change",ul="dppxchange",uu="--",go=typeof window<"u",ih=go?document:null,Jr=go?window:null,jg=go?navigator:null;let ve,ua;function sh(){let i=devicePixelRatio;ve!=i&&(ve=i,ua&&oh(vf,ua,sh),ua=matchMedia(`(min-resolution: ${ve-.001}dppx) and (max-resolution: ${ve+.001}dppx)`),lr(vf,ua,sh),Jr.dispatchEvent(new CustomEvent(ul)))}function Zn(i,t){if(t!=null){let e=i.classList;!e.contains(t)&&e.add(t)}}function rh(i,t){let e=i.classList;e.contains(t)&&e.remove(t)}function Ne(i,t,e){i.style[t]=e+"px"}function vi(i,t,e,n){let s=ih.createElement(i);return t!=null&&Zn(s,t),e?.insertBefore(s,n),s}function ri(i,t){return vi("div",i,t)}const xf=new WeakMap;function Fi(i,t,e,n,s){let r="translate("+t+"px,"+e+"px)",o=xf.get(i);r!=o&&(i.style.transform=r,xf.set(i,r),t<0||e<0||t>n||e>s?Zn(i,nr):rh(i,nr))}const Mf=new WeakMap;function Sf(i,t,e){let n=t+e,s=Mf.get(i);n!=s&&(Mf.set(i,n),i.style.background=t,i.style.borderColor=e)}const yf=new WeakMap;function wf(i,t,e,n){let s=t+""+e,r=yf.get(i);s!=r&&(yf.set(i,s),i.style.height=e+"px",i.style.width=t+"px",i.style.marginLeft=n?-t/2+"px":0,i.style.marginTop=n?-e/2+"px":0)}const fu={passive:!0},$g={...fu,capture:!0};function lr(i,t,e,n){t.addEventListener(i,e,n?$g:fu)}function oh(i,t,e,n){t.removeEventListener(i,e,fu)}go&&sh();function Mi(i,t,e,n){let s;e=e||0,n=n||t.length-1;let r=n<=2147483647;for(;n-e>1;)s=r?e+n>>1:Jn((e+n)/2),t[s]<i?e=s:n=s;return i-t[e]<=t[n]-i?e:n}function Hp(i){return(e,n,s)=>{let r=-1,o=-1;for(let a=n;a<=s;a++)if(i(e[a])){r=a;break}for(let a=s;a>=n;a--)if(i(e[a])){o=a;break}return[r,o]}}const Gp=i=>i!=null,Wp=i=>i!=null&&i>0,Tl=Hp(Gp),Zg=Hp(Wp);function Kg(i,t,e,n=0,s=!1){let r=s?Zg:Tl,o=s?Wp:Gp;[t,e]=r(i,t,e);let a=i[t],l=i[t];if(t>-1)if(n==1)a=i[t],l=i[e];else if(n==-1)a=i[e],l=i[t];else for(let c=t;c<=e;c++){let h=i[c];o(h)&&(h<a?a=h:h>l&&(l=h))}return[a??Ce,l??-Ce]}function Al(i,t,e,n){let s=Af(i),r=Af(t);i==t&&(s==-1?(i*=e,t/=e):(i/=e,t*=e));let o=e==10?is:Xp,a=s==1?Jn:oi,l=r==1?oi:Jn,c=a(o(rn(i))),h=l(o(rn(t))),u=ro(e,c),f=ro(e,h);return e==10&&(c<0&&(u=Le(u,-c)),h<0&&(f=Le(f,-h))),n||e==2?(i=u*s,t=f*r):(i=$p(i,u),t=Rl(t,f)),[i,t]}function du(i,t,e,n){let s=Al(i,t,e,n);return i==0&&(s[0]=0),t==0&&(s[1]=0),s}const pu=.1,Ef={mode:3,pad:pu},Wo={pad:0,soft:null,mode:0},Jg={min:Wo,max:Wo};function fl(i,t,e,n){return Pl(e)?Tf(i,t,e):(Wo.pad=e,Wo.soft=n?0:null,Wo.mode=n?3:0,Tf(i,t,Jg))}function _e(i,t){return i??t}function Qg(i,t,e){for(t=_e(t,0),e=_e(e,i.length-1);t<=e;){if(i[t]!=null)return!0;t++}return!1}function Tf(i,t,e){let n=e.min,s=e.max,r=_e(n.pad,0),o=_e(s.pad,0),a=_e(n.hard,-Ce),l=_e(s.hard,Ce),c=_e(n.soft,Ce),h=_e(s.soft,-Ce),u=_e(n.mode,0),f=_e(s.mode,0),p=t-i,_=is(p),b=On(rn(i),rn(t)),m=is(b),d=rn(m-_);(p<1e-24||d>10)&&(p=0,(i==0||t==0)&&(p=1e-24,u==2&&c!=Ce&&(r=0),f==2&&h!=-Ce&&(o=0)));let S=p||b||1e3,E=is(S),v=ro(10,Jn(E)),U=S*(p==0?i==0?.1:1:r),P=Le($p(i-U,v/10),24),I=i>=c&&(u==1||u==3&&P<=c||u==2&&P>=c)?c:Ce,F=On(a,P<I&&i>=I?I:Si(I,P)),w=S*(p==0?t==0?.1:1:o),x=Le(Rl(t+w,v/10),24),R=t<=h&&(f==1||f==3&&x>=h||f==2&&x<=h)?h:-Ce,G=Si(l,x>R&&t<=R?R:On(R,x));return F==G&&F==0&&(G=100),[F,G]}const t0=new Intl.NumberFormat(go?jg.language:"en-US"),mu=i=>t0.format(i),Qn=Math,Xa=Qn.PI,rn=Qn.abs,Jn=Qn.floor,sn=Qn.round,oi=Qn.ceil,Si=Qn.min,On=Qn.max,ro=Qn.pow,Af=Qn.sign,is=Qn.log10,Xp=Qn.log2,e0=(i,t=1)=>Qn.sinh(i)*t,rc=(i,t=1)=>Qn.asinh(i/t),Ce=1/0;function Rf(i){return(is((i^i>>31)-(i>>31))|0)+1}function ah(i,t,e){return Si(On(i,t),e)}function Yp(i){return typeof i=="function"}function ae(i){return Yp(i)?i:()=>i}const n0=()=>{},qp=i=>i,jp=(i,t)=>t,i0=i=>null,Pf=i=>!0,Cf=(i,t)=>i==t,s0=/\.\d*?(?=9{6,}|0{6,})/gm,hr=i=>{if(Kp(i)||Ps.has(i))return i;const t=`${i}`,e=t.match(s0);if(e==null)return i;let n=e[0].length-1;if(t.indexOf("e-")!=-1){let[s,r]=t.split("e");return+`${hr(s)}e${r}`}return Le(i,n)};function qs(i,t){return hr(Le(hr(i/t))*t)}function Rl(i,t){return hr(oi(hr(i/t))*t)}function $p(i,t){return hr(Jn(hr(i/t))*t)}function Le(i,t=0){if(Kp(i))return i;let e=10**t,n=i*e*(1+Number.EPSILON);return sn(n)/e}const Ps=new Map;function Zp(i){return((""+i).split(".")[1]||"").length}function jo(i,t,e,n){let s=[],r=n.map(Zp);for(let o=t;o<e;o++){let a=rn(o),l=Le(ro(i,o),a);for(let c=0;c<n.length;c++){let h=i==10?+`${n[c]}e${o}`:n[c]*l,u=(o>=0?0:a)+(o>=r[c]?0:r[c]),f=i==10?h:Le(h,u);s.push(f),Ps.set(f,u)}}return s}const Xo={},_u=[],oo=[null,null],ws=Array.isArray,Kp=Number.isInteger,r0=i=>i===void 0;function Lf(i){return typeof i=="string"}function Pl(i){let t=!1;if(i!=null){let e=i.constructor;t=e==null||e==Object}return t}function o0(i){return i!=null&&typeof i=="object"}const a0=Object.getPrototypeOf(Uint8Array),Jp="__proto__";function ao(i,t=Pl){let e;if(ws(i)){let n=i.find(s=>s!=null);if(ws(n)||t(n)){e=Array(i.length);for(let s=0;s<i.length;s++)e[s]=ao(i[s],t)}else e=i.slice()}else if(i instanceof a0)e=i.slice();else if(t(i)){e={};for(let n in i)n!=Jp&&(e[n]=ao(i[n],t))}else e=i;return e}function Ke(i){let t=arguments;for(let e=1;e<t.length;e++){let n=t[e];for(let s in n)s!=Jp&&(Pl(i[s])?Ke(i[s],ao(n[s])):i[s]=ao(n[s]))}return i}const l0=0,c0=1,h0=2;function u0(i,t,e){for(let n=0,s,r=-1;n<t.length;n++){let o=t[n];if(o>r){for(s=o-1;s>=0&&i[s]==null;)i[s--]=null;for(s=o+1;s<e&&i[s]==null;)i[r=s++]=null}}}function f0(i,t){if(m0(i)){let o=i[0].slice();for(let a=1;a<i.length;a++)o.push(...i[a].slice(1));return _0(o[0])||(o=p0(o)),o}let e=new Set;for(let o=0;o<i.length;o++){let l=i[o][0],c=l.length;for(let h=0;h<c;h++)e.add(l[h])}let n=[Array.from(e).sort((o,a)=>o-a)],s=n[0].length,r=new Map;for(let o=0;o<s;o++)r.set(n[0][o],o);for(let o=0;o<i.length;o++){let a=i[o],l=a[0];for(let c=1;c<a.length;c++){let h=a[c],u=Array(s).fill(void 0),f=t?t[o][c]:c0,p=[];for(let _=0;_<h.length;_++){let b=h[_],m=r.get(l[_]);b===null?f!=l0&&(u[m]=b,f==h0&&p.push(m)):u[m]=b}u0(u,p,s),n.push(u)}}return n}const d0=typeof queueMicrotask>"u"?i=>Promise.resolve().then(i):queueMicrotask;function p0(i){let t=i[0],e=t.length,n=Array(e);for(let r=0;r<n.length;r++)n[r]=r;n.sort((r,o)=>t[r]-t[o]);let s=[];for(let r=0;r<i.length;r++){let o=i[r],a=Array(e);for(let l=0;l<e;l++)a[l]=o[n[l]];s.push(a)}return s}function m0(i){let t=i[0][0],e=t.length;for(let n=1;n<i.length;n++){let s=i[n][0];if(s.length!=e)return!1;if(s!=t){for(let r=0;r<e;r++)if(s[r]!=t[r])return!1}}return!0}function _0(i,t=100){const e=i.length;if(e<=1)return!0;let n=0,s=e-1;for(;n<=s&&i[n]==null;)n++;for(;s>=n&&i[s]==null;)s--;if(s<=n)return!0;const r=On(1,Jn((s-n+1)/t));for(let o=i[n],a=n+r;a<=s;a+=r){const l=i[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}const Qp=["January","February","March","April","May","June","July","August","September","October","November","December"],tm=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function em(i){return i.slice(0,3)}const g0=tm.map(em),b0=Qp.map(em),v0={MMMM:Qp,MMM:b0,WWWW:tm,WWW:g0};function Po(i){return(i<10?"0":"")+i}function x0(i){return(i<10?"00":i<100?"0":"")+i}const M0={YYYY:i=>i.getFullYear(),YY:i=>(i.getFullYear()+"").slice(2),MMMM:(i,t)=>t.MMMM[i.getMonth()],MMM:(i,t)=>t.MMM[i.getMonth()],MM:i=>Po(i.getMonth()+1),M:i=>i.getMonth()+1,DD:i=>Po(i.getDate()),D:i=>i.getDate(),WWWW:(i,t)=>t.WWWW[i.getDay()],WWW:(i,t)=>t.WWW[i.getDay()],HH:i=>Po(i.getHours()),H:i=>i.getHours(),h:i=>{let t=i.getHours();return t==0?12:t>12?t-12:t},AA:i=>i.getHours()>=12?"PM":"AM",aa:i=>i.getHours()>=12?"pm":"am",a:i=>i.getHours()>=12?"p":"a",mm:i=>Po(i.getMinutes()),m:i=>i.getMinutes(),ss:i=>Po(i.getSeconds()),s:i=>i.getSeconds(),fff:i=>x0(i.getMilliseconds())};function gu(i,t){t=t||v0;let e=[],n=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=n.exec(i);)e.push(s[0][0]=="{"?M0[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<e.length;a++)o+=typeof e[a]=="string"?e[a]:e[a](r,t);return o}}const S0=new Intl.DateTimeFormat().resolvedOptions().timeZone;function y0(i,t){let e;return t=="UTC"||t=="Etc/UTC"?e=new Date(+i+i.getTimezoneOffset()*6e4):t==S0?e=i:(e=new Date(i.toLocaleString("en-US",{timeZone:t})),e.setMilliseconds(i.getMilliseconds())),e}const nm=i=>i%1==0,dl=[1,2,2.5,5],w0=jo(10,-32,0,dl),im=jo(10,0,32,dl),E0=im.filter(nm),js=w0.concat(im),bu=`
`,sm="{YYYY}",If=bu+sm,rm="{M}/{D}",Vo=bu+rm,fa=Vo+"/{YY}",om="{aa}",T0="{h}:{mm}",Xr=T0+om,Ff=bu+Xr,Df=":{ss}",Me=null;function am(i){let t=i*1e3,e=t*60,n=e*60,s=n*24,r=s*30,o=s*365,l=(i==1?jo(10,0,3,dl).filter(nm):jo(10,-3,0,dl)).concat([t,t*5,t*10,t*15,t*30,e,e*5,e*10,e*15,e*30,n,n*2,n*3,n*4,n*6,n*8,n*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]);const c=[[o,sm,Me,Me,Me,Me,Me,Me,1],[s*28,"{MMM}",If,Me,Me,Me,Me,Me,1],[s,rm,If,Me,Me,Me,Me,Me,1],[n,"{h}"+om,fa,Me,Vo,Me,Me,Me,1],[e,Xr,fa,Me,Vo,Me,Me,Me,1],[t,Df,fa+" "+Xr,Me,Vo+" "+Xr,Me,Ff,Me,1],[i,Df+".{fff}",fa+" "+Xr,Me,Vo+" "+Xr,Me,Ff,Me,1]];function h(u){return(f,p,_,b,m,d)=>{let S=[],E=m>=o,v=m>=r&&m<o,U=u(_),P=Le(U*i,3),I=oc(U.getFullYear(),E?0:U.getMonth(),v||E?1:U.getDate()),F=Le(I*i,3);if(v||E){let w=v?m/r:0,x=E?m/o:0,R=P==F?P:Le(oc(I.getFullYear()+x,I.getMonth()+w,1)*i,3),G=new Date(sn(R/i)),O=G.getFullYear(),$=G.getMonth();for(let Y=0;R<=b;Y++){let J=oc(O+x*Y,$+w*Y,1),K=J-u(Le(J*i,3));R=Le((+J+K)*i,3),R<=b&&S.push(R)}}else{let w=m>=s?s:m,x=Jn(_)-Jn(P),R=F+x+Rl(P-F,w);S.push(R);let G=u(R),O=G.getHours()+G.getMinutes()/e+G.getSeconds()/n,$=m/n,Y=f.axes[p]._space,J=d/Y;for(;R=Le(R+m,i==1?0:3),!(R>b);)if($>1){let K=Jn(Le(O+$,6))%24,ht=u(R).getHours()-K;ht>1&&(ht=-1),R-=ht*n,O=(O+$)%24;let _t=S[S.length-1];Le((R-_t)/m,3)*J>=.7&&S.push(R)}else S.push(R)}return S}}return[l,c,h]}const[A0,R0,P0]=am(1),[C0,L0,I0]=am(.001);jo(2,-53,53,[1]);function Uf(i,t){return i.map(e=>e.map((n,s)=>s==0||s==8||n==null?n:t(s==1||e[8]==0?n:e[1]+n)))}function Nf(i,t){return(e,n,s,r,o)=>{let a=t.find(_=>o>=_[0])||t[t.length-1],l,c,h,u,f,p;return n.map(_=>{let b=i(_),m=b.getFullYear(),d=b.getMonth(),S=b.getDate(),E=b.getHours(),v=b.getMinutes(),U=b.getSeconds(),P=m!=l&&a[2]||d!=c&&a[3]||S!=h&&a[4]||E!=u&&a[5]||v!=f&&a[6]||U!=p&&a[7]||a[1];return l=m,c=d,h=S,u=E,f=v,p=U,P(b)})}}function F0(i,t){let e=gu(t);return(n,s,r,o,a)=>s.map(l=>e(i(l)))}function oc(i,t,e){return new Date(i,t,e)}function Of(i,t){return t(i)}const D0="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function kf(i,t){return(e,n,s,r)=>r==null?uu:t(i(n))}function U0(i,t){let e=i.series[t];return e.width?e.stroke(i,t):e.points.width?e.points.stroke(i,t):null}function N0(i,t){return i.series[t].fill(i,t)}const O0={show:!0,live:!0,isolate:!1,mount:n0,markers:{show:!0,width:2,stroke:U0,fill:N0,dash:"solid"},idx:null,idxs:null,values:[]};function k0(i,t){let e=i.cursor.points,n=ri(),s=e.size(i,t);Ne(n,Bo,s),Ne(n,zo,s);let r=s/-2;Ne(n,"marginLeft",r),Ne(n,"marginTop",r);let o=e.width(i,t,s);return o&&Ne(n,"borderWidth",o),n}function B0(i,t){let e=i.series[t].points;return e._fill||e._stroke}function z0(i,t){let e=i.series[t].points;return e._stroke||e._fill}function V0(i,t){return i.series[t].points.size}const ac=[0,0];function H0(i,t,e){return ac[0]=t,ac[1]=e,ac}function da(i,t,e,n=!0){return s=>{s.button==0&&(!n||s.target==t)&&e(s)}}function lc(i,t,e,n=!0){return s=>{(!n||s.target==t)&&e(s)}}const G0={show:!0,x:!0,y:!0,lock:!1,move:H0,points:{one:!1,show:k0,size:V0,width:0,stroke:z0,fill:B0},bind:{mousedown:da,mouseup:da,click:da,dblclick:da,mousemove:lc,mouseleave:lc,mouseenter:lc},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(i,t)=>{t.stopPropagation(),t.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(i,t,e,n,s)=>n-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},lm={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},vu=Ke({},lm,{filter:jp}),cm=Ke({},vu,{size:10}),hm=Ke({},lm,{show:!1}),xu='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',um="bold "+xu,fm=1.5,Bf={show:!0,scale:"x",stroke:hu,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:um,side:2,grid:vu,ticks:cm,border:hm,font:xu,lineGap:fm,rotate:0},W0="Value",X0="Time",zf={show:!0,scale:"x",auto:!1,sorted:1,min:Ce,max:-Ce,idxs:[]};function Y0(i,t,e,n,s){return t.map(r=>r==null?"":mu(r))}function q0(i,t,e,n,s,r,o){let a=[],l=Ps.get(s)||0;e=o?e:Le(Rl(e,s),l);for(let c=e;c<=n;c=Le(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function lh(i,t,e,n,s,r,o){const a=[],l=i.scales[i.axes[t].scale].log,c=l==10?is:Xp,h=Jn(c(e));s=ro(l,h),l==10&&(s=js[Mi(s,js)]);let u=e,f=s*l;l==10&&(f=js[Mi(f,js)]);do a.push(u),u=u+s,l==10&&!Ps.has(u)&&(u=Le(u,Ps.get(s))),u>=f&&(s=u,f=s*l,l==10&&(f=js[Mi(f,js)]));while(u<=n);return a}function j0(i,t,e,n,s,r,o){let l=i.scales[i.axes[t].scale].asinh,c=n>l?lh(i,t,On(l,e),n,s):[l],h=n>=0&&e<=0?[0]:[];return(e<-l?lh(i,t,On(l,-n),-e,s):[l]).reverse().map(f=>-f).concat(h,c)}const dm=/./,$0=/[12357]/,Z0=/[125]/,Vf=/1/,ch=(i,t,e,n)=>i.map((s,r)=>t==4&&s==0||r%n==0&&e.test(s.toExponential()[s<0?1:0])?s:null);function K0(i,t,e,n,s){let r=i.axes[e],o=r.scale,a=i.scales[o],l=i.valToPos,c=r._space,h=l(10,o),u=l(9,o)-h>=c?dm:l(7,o)-h>=c?$0:l(5,o)-h>=c?Z0:Vf;if(u==Vf){let f=rn(l(1,o)-h);if(f<c)return ch(t.slice().reverse(),a.distr,u,oi(c/f)).reverse()}return ch(t,a.distr,u,1)}function J0(i,t,e,n,s){let r=i.axes[e],o=r.scale,a=r._space,l=i.valToPos,c=rn(l(1,o)-l(2,o));return c<a?ch(t.slice().reverse(),3,dm,oi(a/c)).reverse():t}function Q0(i,t,e,n){return n==null?uu:t==null?"":mu(t)}const Hf={show:!0,scale:"y",stroke:hu,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:um,side:3,grid:vu,ticks:cm,border:hm,font:xu,lineGap:fm,rotate:0};function tb(i,t){let e=3+(i||1)*2;return Le(e*t,3)}function eb(i,t){let{scale:e,idxs:n}=i.series[0],s=i._data[0],r=i.valToPos(s[n[0]],e,!0),o=i.valToPos(s[n[1]],e,!0),a=rn(o-r),l=i.series[t],c=a/(l.points.space*ve);return n[1]-n[0]<=c}const Gf={scale:null,auto:!0,sorted:0,min:Ce,max:-Ce},pm=(i,t,e,n,s)=>s,Wf={show:!0,auto:!0,sorted:0,gaps:pm,alpha:1,facets:[Ke({},Gf,{scale:"x"}),Ke({},Gf,{scale:"y"})]},Xf={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:pm,alpha:1,points:{show:eb,filter:null},values:null,min:Ce,max:-Ce,idxs:[],path:null,clip:null};function nb(i,t,e,n,s){return e/10}const mm={time:Ag,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},ib=Ke({},mm,{time:!1,ori:1}),Yf={};function _m(i,t){let e=Yf[i];return e||(e={key:i,plots:[],sub(n){e.plots.push(n)},unsub(n){e.plots=e.plots.filter(s=>s!=n)},pub(n,s,r,o,a,l,c){for(let h=0;h<e.plots.length;h++)e.plots[h]!=s&&e.plots[h].pub(n,s,r,o,a,l,c)}},i!=null&&(Yf[i]=e)),e}const lo=1,hh=2;function dr(i,t,e){const n=i.mode,s=i.series[t],r=n==2?i._data[t]:i._data,o=i.scales,a=i.bbox;let l=r[0],c=n==2?r[1]:r[t],h=n==2?o[s.facets[0].scale]:o[i.series[0].scale],u=n==2?o[s.facets[1].scale]:o[s.scale],f=a.left,p=a.top,_=a.width,b=a.height,m=i.valToPosH,d=i.valToPosV;return h.ori==0?e(s,l,c,h,u,m,d,f,p,_,b,Ll,bo,Fl,bm,xm):e(s,l,c,h,u,d,m,p,f,b,_,Il,vo,yu,vm,Mm)}function Mu(i,t){let e=0,n=0,s=_e(i.bands,_u);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==t?e=o.dir:o.series[1]==t&&(o.dir==1?n|=1:n|=2)}return[e,n==1?-1:n==2?1:n==3?2:0]}function sb(i,t,e,n,s){let r=i.mode,o=i.series[t],a=r==2?o.facets[1].scale:o.scale,l=i.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function ss(i,t,e,n,s,r){return dr(i,t,(o,a,l,c,h,u,f,p,_,b,m)=>{let d=o.pxRound;const S=c.dir*(c.ori==0?1:-1),E=c.ori==0?bo:vo;let v,U;S==1?(v=e,U=n):(v=n,U=e);let P=d(u(a[v],c,b,p)),I=d(f(l[v],h,m,_)),F=d(u(a[U],c,b,p)),w=d(f(r==1?h.max:h.min,h,m,_)),x=new Path2D(s);return E(x,F,w),E(x,P,w),E(x,P,I),x})}function Cl(i,t,e,n,s,r){let o=null;if(i.length>0){o=new Path2D;const a=t==0?Fl:yu;let l=e;for(let u=0;u<i.length;u++){let f=i[u];if(f[1]>f[0]){let p=f[0]-l;p>0&&a(o,l,n,p,n+r),l=f[1]}}let c=e+s-l,h=10;c>0&&a(o,l,n-h/2,c,n+r+h)}return o}function rb(i,t,e){let n=i[i.length-1];n&&n[0]==t?n[1]=e:i.push([t,e])}function Su(i,t,e,n,s,r,o){let a=[],l=i.length;for(let c=s==1?e:n;c>=e&&c<=n;c+=s)if(t[c]===null){let u=c,f=c;if(s==1)for(;++c<=n&&t[c]===null;)f=c;else for(;--c>=e&&t[c]===null;)f=c;let p=r(i[u]),_=f==u?p:r(i[f]),b=u-s;p=o<=0&&b>=0&&b<l?r(i[b]):p;let d=f+s;_=o>=0&&d>=0&&d<l?r(i[d]):_,_>=p&&a.push([p,_])}return a}function qf(i){return i==0?qp:i==1?sn:t=>qs(t,i)}function gm(i){let t=i==0?Ll:Il,e=i==0?(s,r,o,a,l,c)=>{s.arcTo(r,o,a,l,c)}:(s,r,o,a,l,c)=>{s.arcTo(o,r,l,a,c)},n=i==0?(s,r,o,a,l)=>{s.rect(r,o,a,l)}:(s,r,o,a,l)=>{s.rect(o,r,l,a)};return(s,r,o,a,l,c=0,h=0)=>{c==0&&h==0?n(s,r,o,a,l):(c=Si(c,a/2,l/2),h=Si(h,a/2,l/2),t(s,r+c,o),e(s,r+a,o,r+a,o+l,c),e(s,r+a,o+l,r,o+l,h),e(s,r,o+l,r,o,h),e(s,r,o,r+a,o,c),s.closePath())}}const Ll=(i,t,e)=>{i.moveTo(t,e)},Il=(i,t,e)=>{i.moveTo(e,t)},bo=(i,t,e)=>{i.lineTo(t,e)},vo=(i,t,e)=>{i.lineTo(e,t)},Fl=gm(0),yu=gm(1),bm=(i,t,e,n,s,r)=>{i.arc(t,e,n,s,r)},vm=(i,t,e,n,s,r)=>{i.arc(e,t,n,s,r)},xm=(i,t,e,n,s,r,o)=>{i.bezierCurveTo(t,e,n,s,r,o)},Mm=(i,t,e,n,s,r,o)=>{i.bezierCurveTo(e,t,s,n,o,r)};function Sm(i){return(t,e,n,s,r)=>dr(t,e,(o,a,l,c,h,u,f,p,_,b,m)=>{let{pxRound:d,points:S}=o,E,v;c.ori==0?(E=Ll,v=bm):(E=Il,v=vm);const U=Le(S.width*ve,3);let P=(S.size-S.width)/2*ve,I=Le(P*2,3),F=new Path2D,w=new Path2D,{left:x,top:R,width:G,height:O}=t.bbox;Fl(w,x-I,R-I,G+I*2,O+I*2);const $=Y=>{if(l[Y]!=null){let J=d(u(a[Y],c,b,p)),K=d(f(l[Y],h,m,_));E(F,J+P,K),v(F,J,K,P,0,Xa*2)}};if(r)r.forEach($);else for(let Y=n;Y<=s;Y++)$(Y);return{stroke:U>0?F:null,fill:F,clip:w,flags:lo|hh}})}function ym(i){return(t,e,n,s,r,o)=>{n!=s&&(r!=n&&o!=n&&i(t,e,n),r!=s&&o!=s&&i(t,e,s),i(t,e,o))}}const ob=ym(bo),ab=ym(vo);function wm(i){const t=_e(i?.alignGaps,0);return(e,n,s,r)=>dr(e,n,(o,a,l,c,h,u,f,p,_,b,m)=>{[s,r]=Tl(l,s,r);let d=o.pxRound,S=O=>d(u(O,c,b,p)),E=O=>d(f(O,h,m,_)),v,U;c.ori==0?(v=bo,U=ob):(v=vo,U=ab);const P=c.dir*(c.ori==0?1:-1),I={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:lo},F=I.stroke;let w=!1;if(r-s>=b*4){let O=mt=>e.posToVal(mt,c.key,!0),$=null,Y=null,J,K,et,ft=S(a[P==1?s:r]),ht=S(a[s]),_t=S(a[r]),Mt=O(P==1?ht+1:_t-1);for(let mt=P==1?s:r;mt>=s&&mt<=r;mt+=P){let st=a[mt],gt=(P==1?st<Mt:st>Mt)?ft:S(st),at=l[mt];gt==ft?at!=null?(K=at,$==null?(v(F,gt,E(K)),J=$=Y=K):K<$?$=K:K>Y&&(Y=K)):at===null&&(w=!0):($!=null&&U(F,ft,E($),E(Y),E(J),E(K)),at!=null?(K=at,v(F,gt,E(K)),$=Y=J=K):($=Y=null,at===null&&(w=!0)),ft=gt,Mt=O(ft+P))}$!=null&&$!=Y&&et!=ft&&U(F,ft,E($),E(Y),E(J),E(K))}else for(let O=P==1?s:r;O>=s&&O<=r;O+=P){let $=l[O];$===null?w=!0:$!=null&&v(F,S(a[O]),E($))}let[R,G]=Mu(e,n);if(o.fill!=null||R!=0){let O=I.fill=new Path2D(F),$=o.fillTo(e,n,o.min,o.max,R),Y=E($),J=S(a[s]),K=S(a[r]);P==-1&&([K,J]=[J,K]),v(O,K,Y),v(O,J,Y)}if(!o.spanGaps){let O=[];w&&O.push(...Su(a,l,s,r,P,S,t)),I.gaps=O=o.gaps(e,n,s,r,O),I.clip=Cl(O,c.ori,p,_,b,m)}return G!=0&&(I.band=G==2?[ss(e,n,s,r,F,-1),ss(e,n,s,r,F,1)]:ss(e,n,s,r,F,G)),I})}function lb(i){const t=_e(i.align,1),e=_e(i.ascDesc,!1),n=_e(i.alignGaps,0),s=_e(i.extend,!1);return(r,o,a,l)=>dr(r,o,(c,h,u,f,p,_,b,m,d,S,E)=>{[a,l]=Tl(u,a,l);let v=c.pxRound,{left:U,width:P}=r.bbox,I=ht=>v(_(ht,f,S,m)),F=ht=>v(b(ht,p,E,d)),w=f.ori==0?bo:vo;const x={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:lo},R=x.stroke,G=f.dir*(f.ori==0?1:-1);let O=F(u[G==1?a:l]),$=I(h[G==1?a:l]),Y=$,J=$;s&&t==-1&&(J=U,w(R,J,O)),w(R,$,O);for(let ht=G==1?a:l;ht>=a&&ht<=l;ht+=G){let _t=u[ht];if(_t==null)continue;let Mt=I(h[ht]),mt=F(_t);t==1?w(R,Mt,O):w(R,Y,mt),w(R,Mt,mt),O=mt,Y=Mt}let K=Y;s&&t==1&&(K=U+P,w(R,K,O));let[et,ft]=Mu(r,o);if(c.fill!=null||et!=0){let ht=x.fill=new Path2D(R),_t=c.fillTo(r,o,c.min,c.max,et),Mt=F(_t);w(ht,K,Mt),w(ht,J,Mt)}if(!c.spanGaps){let ht=[];ht.push(...Su(h,u,a,l,G,I,n));let _t=c.width*ve/2,Mt=e||t==1?_t:-_t,mt=e||t==-1?-_t:_t;ht.forEach(st=>{st[0]+=Mt,st[1]+=mt}),x.gaps=ht=c.gaps(r,o,a,l,ht),x.clip=Cl(ht,f.ori,m,d,S,E)}return ft!=0&&(x.band=ft==2?[ss(r,o,a,l,R,-1),ss(r,o,a,l,R,1)]:ss(r,o,a,l,R,ft)),x})}function jf(i,t,e,n,s,r,o=Ce){if(i.length>1){let a=null;for(let l=0,c=1/0;l<i.length;l++)if(t[l]!==void 0){if(a!=null){let h=rn(i[l]-i[a]);h<c&&(c=h,o=rn(e(i[l],n,s,r)-e(i[a],n,s,r)))}a=l}}return o}function cb(i){i=i||Xo;const t=_e(i.size,[.6,Ce,1]),e=i.align||0,n=i.gap||0;let s=i.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;const r=ae(s),o=1-t[0],a=_e(t[1],Ce),l=_e(t[2],1),c=_e(i.disp,Xo),h=_e(i.each,p=>{}),{fill:u,stroke:f}=c;return(p,_,b,m)=>dr(p,_,(d,S,E,v,U,P,I,F,w,x,R)=>{let G=d.pxRound,O=e,$=n*ve,Y=a*ve,J=l*ve,K,et;v.ori==0?[K,et]=r(p,_):[et,K]=r(p,_);const ft=v.dir*(v.ori==0?1:-1);let ht=v.ori==0?Fl:yu,_t=v.ori==0?h:(W,nt,St,bt,Tt,Zt,dt)=>{h(W,nt,St,Tt,bt,dt,Zt)},Mt=_e(p.bands,_u).find(W=>W.series[0]==_),mt=Mt!=null?Mt.dir:0,st=d.fillTo(p,_,d.min,d.max,mt),lt=G(I(st,U,R,w)),gt,at,zt,Ht=x,Ut=G(d.width*ve),le=!1,Kt=null,ce=null,V=null,tn=null;u!=null&&(Ut==0||f!=null)&&(le=!0,Kt=u.values(p,_,b,m),ce=new Map,new Set(Kt).forEach(W=>{W!=null&&ce.set(W,new Path2D)}),Ut>0&&(V=f.values(p,_,b,m),tn=new Map,new Set(V).forEach(W=>{W!=null&&tn.set(W,new Path2D)})));let{x0:Qt,size:ee}=c;if(Qt!=null&&ee!=null){O=1,S=Qt.values(p,_,b,m),Qt.unit==2&&(S=S.map(St=>p.posToVal(F+St*x,v.key,!0)));let W=ee.values(p,_,b,m);ee.unit==2?at=W[0]*x:at=P(W[0],v,x,F)-P(0,v,x,F),Ht=jf(S,E,P,v,x,F,Ht),zt=Ht-at+$}else Ht=jf(S,E,P,v,x,F,Ht),zt=Ht*o+$,at=Ht-zt;zt<1&&(zt=0),Ut>=at/2&&(Ut=0),zt<5&&(G=qp);let Gt=zt>0,fe=Ht-zt-(Gt?Ut:0);at=G(ah(fe,J,Y)),gt=(O==0?at/2:O==ft?0:at)-O*ft*((O==0?$/2:0)+(Gt?Ut/2:0));const Lt={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},C=le?null:new Path2D;let y=null;if(Mt!=null)y=p.data[Mt.series[1]];else{let{y0:W,y1:nt}=c;W!=null&&nt!=null&&(E=nt.values(p,_,b,m),y=W.values(p,_,b,m))}let Z=K*at,Q=et*at;for(let W=ft==1?b:m;W>=b&&W<=m;W+=ft){let nt=E[W];if(nt==null)continue;if(y!=null){let kt=y[W]??0;if(nt-kt==0)continue;lt=I(kt,U,R,w)}let St=v.distr!=2||c!=null?S[W]:W,bt=P(St,v,x,F),Tt=I(_e(nt,st),U,R,w),Zt=G(bt-gt),dt=G(On(Tt,lt)),vt=G(Si(Tt,lt)),Nt=dt-vt;if(nt!=null){let kt=nt<0?Q:Z,wt=nt<0?Z:Q;le?(Ut>0&&V[W]!=null&&ht(tn.get(V[W]),Zt,vt+Jn(Ut/2),at,On(0,Nt-Ut),kt,wt),Kt[W]!=null&&ht(ce.get(Kt[W]),Zt,vt+Jn(Ut/2),at,On(0,Nt-Ut),kt,wt)):ht(C,Zt,vt+Jn(Ut/2),at,On(0,Nt-Ut),kt,wt),_t(p,_,W,Zt-Ut/2,vt,at+Ut,Nt)}}return Ut>0?Lt.stroke=le?tn:C:le||(Lt._fill=d.width==0?d._fill:d._stroke??d._fill,Lt.width=0),Lt.fill=le?ce:C,Lt})}function hb(i,t){const e=_e(t?.alignGaps,0);return(n,s,r,o)=>dr(n,s,(a,l,c,h,u,f,p,_,b,m,d)=>{[r,o]=Tl(c,r,o);let S=a.pxRound,E=K=>S(f(K,h,m,_)),v=K=>S(p(K,u,d,b)),U,P,I;h.ori==0?(U=Ll,I=bo,P=xm):(U=Il,I=vo,P=Mm);const F=h.dir*(h.ori==0?1:-1);let w=E(l[F==1?r:o]),x=w,R=[],G=[];for(let K=F==1?r:o;K>=r&&K<=o;K+=F)if(c[K]!=null){let ft=l[K],ht=E(ft);R.push(x=ht),G.push(v(c[K]))}const O={stroke:i(R,G,U,I,P,S),fill:null,clip:null,band:null,gaps:null,flags:lo},$=O.stroke;let[Y,J]=Mu(n,s);if(a.fill!=null||Y!=0){let K=O.fill=new Path2D($),et=a.fillTo(n,s,a.min,a.max,Y),ft=v(et);I(K,x,ft),I(K,w,ft)}if(!a.spanGaps){let K=[];K.push(...Su(l,c,r,o,F,E,e)),O.gaps=K=a.gaps(n,s,r,o,K),O.clip=Cl(K,h.ori,_,b,m,d)}return J!=0&&(O.band=J==2?[ss(n,s,r,o,$,-1),ss(n,s,r,o,$,1)]:ss(n,s,r,o,$,J)),O})}function ub(i){return hb(fb,i)}function fb(i,t,e,n,s,r){const o=i.length;if(o<2)return null;const a=new Path2D;if(e(a,i[0],t[0]),o==2)n(a,i[1],t[1]);else{let l=Array(o),c=Array(o-1),h=Array(o-1),u=Array(o-1);for(let f=0;f<o-1;f++)h[f]=t[f+1]-t[f],u[f]=i[f+1]-i[f],c[f]=h[f]/u[f];l[0]=c[0];for(let f=1;f<o-1;f++)c[f]===0||c[f-1]===0||c[f-1]>0!=c[f]>0?l[f]=0:(l[f]=3*(u[f-1]+u[f])/((2*u[f]+u[f-1])/c[f-1]+(u[f]+2*u[f-1])/c[f]),isFinite(l[f])||(l[f]=0));l[o-1]=c[o-2];for(let f=0;f<o-1;f++)s(a,i[f]+u[f]/3,t[f]+l[f]*u[f]/3,i[f+1]-u[f]/3,t[f+1]-l[f+1]*u[f]/3,i[f+1],t[f+1])}return a}const uh=new Set;function $f(){for(let i of uh)i.syncRect(!0)}go&&(lr(Yg,Jr,$f),lr(qg,Jr,$f,!0),lr(ul,Jr,()=>{ln.pxRatio=ve}));const db=wm(),pb=Sm();function Zf(i,t,e,n){return(n?[i[0],i[1]].concat(i.slice(2)):[i[0]].concat(i.slice(1))).map((r,o)=>fh(r,o,t,e))}function mb(i,t){return i.map((e,n)=>n==0?{}:Ke({},t,e))}function fh(i,t,e,n){return Ke({},t==0?e:n,i)}function Em(i,t,e){return t==null?oo:[t,e]}const _b=Em;function gb(i,t,e){return t==null?oo:fl(t,e,pu,!0)}function Tm(i,t,e,n){return t==null?oo:Al(t,e,i.scales[n].log,!1)}const bb=Tm;function Am(i,t,e,n){return t==null?oo:du(t,e,i.scales[n].log,!1)}const vb=Am;function xb(i,t,e,n,s){let r=On(Rf(i),Rf(t)),o=t-i,a=Mi(s/n*o,e);do{let l=e[a],c=n*l/o;if(c>=s&&r+(l<5?Ps.get(l):0)<=17)return[l,c]}while(++a<e.length);return[0,0]}function Kf(i){let t,e;return i=i.replace(/(\d+)px/,(n,s)=>(t=sn((e=+s)*ve))+"px"),[i,t,e]}function Mb(i){i.show&&[i.font,i.labelFont].forEach(t=>{let e=Le(t[2]*ve,1);t[0]=t[0].replace(/[0-9.]+px/,e+"px"),t[1]=e})}function ln(i,t,e){const n={mode:_e(i.mode,1)},s=n.mode;function r(g,M,A,L){let N=M.valToPct(g);return L+A*(M.dir==-1?1-N:N)}function o(g,M,A,L){let N=M.valToPct(g);return L+A*(M.dir==-1?N:1-N)}function a(g,M,A,L){return M.ori==0?r(g,M,A,L):o(g,M,A,L)}n.valToPosH=r,n.valToPosV=o;let l=!1;n.status=0;const c=n.root=ri(Rg);if(i.id!=null&&(c.id=i.id),Zn(c,i.class),i.title){let g=ri(Lg,c);g.textContent=i.title}const h=vi("canvas"),u=n.ctx=h.getContext("2d"),f=ri(Ig,c);lr("click",f,g=>{g.target===_&&(Fe!=yr||Be!=wr)&&Mn.click(n,g)},!0);const p=n.under=ri(Fg,f);f.appendChild(h);const _=n.over=ri(Dg,f);i=ao(i);const b=+_e(i.pxAlign,1),m=qf(b);(i.plugins||[]).forEach(g=>{g.opts&&(i=g.opts(n,i)||i)});const d=i.ms||.001,S=n.series=s==1?Zf(i.series||[],zf,Xf,!1):mb(i.series||[null],Wf),E=n.axes=Zf(i.axes||[],Bf,Hf,!0),v=n.scales={},U=n.bands=i.bands||[];U.forEach(g=>{g.fill=ae(g.fill||null),g.dir=_e(g.dir,-1)});const P=s==2?S[1].facets[0].scale:S[0].scale,I={axes:A_,series:ti},F=(i.drawOrder||["axes","series"]).map(g=>I[g]);function w(g){const M=g.distr==3?A=>is(A>0?A:g.clamp(n,A,g.min,g.max,g.key)):g.distr==4?A=>rc(A,g.asinh):g.distr==100?A=>g.fwd(A):A=>A;return A=>{let L=M(A),{_min:N,_max:j}=g,rt=j-N;return(L-N)/rt}}function x(g){let M=v[g];if(M==null){let A=(i.scales||Xo)[g]||Xo;if(A.from!=null){x(A.from);let L=Ke({},v[A.from],A,{key:g});L.valToPct=w(L),v[g]=L}else{M=v[g]=Ke({},g==P?mm:ib,A),M.key=g;let L=M.time,N=M.range,j=ws(N);if((g!=P||s==2&&!L)&&(j&&(N[0]==null||N[1]==null)&&(N={min:N[0]==null?Ef:{mode:1,hard:N[0],soft:N[0]},max:N[1]==null?Ef:{mode:1,hard:N[1],soft:N[1]}},j=!1),!j&&Pl(N))){let rt=N;N=(ct,pt,Pt)=>pt==null?oo:fl(pt,Pt,rt)}M.range=ae(N||(L?_b:g==P?M.distr==3?bb:M.distr==4?vb:Em:M.distr==3?Tm:M.distr==4?Am:gb)),M.auto=ae(j?!1:M.auto),M.clamp=ae(M.clamp||nb),M._min=M._max=null,M.valToPct=w(M)}}}x("x"),x("y"),s==1&&S.forEach(g=>{x(g.scale)}),E.forEach(g=>{x(g.scale)});for(let g in i.scales)x(g);const R=v[P],G=R.distr;let O,$;R.ori==0?(Zn(c,Pg),O=r,$=o):(Zn(c,Cg),O=o,$=r);const Y={};for(let g in v){let M=v[g];(M.min!=null||M.max!=null)&&(Y[g]={min:M.min,max:M.max},M.min=M.max=null)}const J=i.tzDate||(g=>new Date(sn(g/d))),K=i.fmtDate||gu,et=d==1?P0(J):I0(J),ft=Nf(J,Uf(d==1?R0:L0,K)),ht=kf(J,Of(D0,K)),_t=[],Mt=n.legend=Ke({},O0,i.legend),mt=n.cursor=Ke({},G0,{drag:{y:s==2}},i.cursor),st=Mt.show,lt=mt.show,gt=Mt.markers;Mt.idxs=_t,gt.width=ae(gt.width),gt.dash=ae(gt.dash),gt.stroke=ae(gt.stroke),gt.fill=ae(gt.fill);let at,zt,Ht,Ut=[],le=[],Kt,ce=!1,V={};if(Mt.live){const g=S[1]?S[1].values:null;ce=g!=null,Kt=ce?g(n,1,0):{_:0};for(let M in Kt)V[M]=uu}if(st)if(at=vi("table",zg,c),Ht=vi("tbody",null,at),Mt.mount(n,at),ce){zt=vi("thead",null,at,Ht);let g=vi("tr",null,zt);vi("th",null,g);for(var tn in Kt)vi("th",ff,g).textContent=tn}else Zn(at,Hg),Mt.live&&Zn(at,Vg);const Qt={show:!0},ee={show:!1};function Gt(g,M){if(M==0&&(ce||!Mt.live||s==2))return oo;let A=[],L=vi("tr",Gg,Ht,Ht.childNodes[M]);Zn(L,g.class),g.show||Zn(L,nr);let N=vi("th",null,L);if(gt.show){let ct=ri(Wg,N);if(M>0){let pt=gt.width(n,M);pt&&(ct.style.border=pt+"px "+gt.dash(n,M)+" "+gt.stroke(n,M)),ct.style.background=gt.fill(n,M)}}let j=ri(ff,N);g.label instanceof HTMLElement?j.appendChild(g.label):j.textContent=g.label,M>0&&(gt.show||(j.style.color=g.width>0?gt.stroke(n,M):gt.fill(n,M)),Lt("click",N,ct=>{if(mt._lock)return;en(ct);let pt=S.indexOf(g);if((ct.ctrlKey||ct.metaKey)!=Mt.isolate){let Pt=S.some((Ct,It)=>It>0&&It!=pt&&Ct.show);S.forEach((Ct,It)=>{It>0&&Pi(It,Pt?It==pt?Qt:ee:Qt,!0,qe.setSeries)})}else Pi(pt,{show:!g.show},!0,qe.setSeries)},!1),zi&&Lt(_f,N,ct=>{mt._lock||(en(ct),Pi(S.indexOf(g),Tr,!0,qe.setSeries))},!1));for(var rt in Kt){let ct=vi("td",Xg,L);ct.textContent="--",A.push(ct)}return[L,A]}const fe=new Map;function Lt(g,M,A,L=!0){const N=fe.get(M)||{},j=mt.bind[g](n,M,A,L);j&&(lr(g,M,N[g]=j),fe.set(M,N))}function C(g,M,A){const L=fe.get(M)||{};for(let N in L)(g==null||N==g)&&(oh(N,M,L[N]),delete L[N]);g==null&&fe.delete(M)}let y=0,Z=0,Q=0,W=0,nt=0,St=0,bt=nt,Tt=St,Zt=Q,dt=W,vt=0,Nt=0,kt=0,wt=0;n.bbox={};let se=!1,jt=!1,de=!1,z=!1,xt=!1,it=!1;function ot(g,M,A){(A||g!=n.width||M!=n.height)&&At(g,M),vr(!1),de=!0,jt=!0,xr()}function At(g,M){n.width=y=Q=g,n.height=Z=W=M,nt=St=0,fn(),ge();let A=n.bbox;vt=A.left=qs(nt*ve,.5),Nt=A.top=qs(St*ve,.5),kt=A.width=qs(Q*ve,.5),wt=A.height=qs(W*ve,.5)}const Rt=3;function Jt(){let g=!1,M=0;for(;!g;){M++;let A=E_(M),L=T_(M);g=M==Rt||A&&L,g||(At(n.width,n.height),jt=!0)}}function Oe({width:g,height:M}){ot(g,M)}n.setSize=Oe;function fn(){let g=!1,M=!1,A=!1,L=!1;E.forEach((N,j)=>{if(N.show&&N._show){let{side:rt,_size:ct}=N,pt=rt%2,Pt=N.label!=null?N.labelSize:0,Ct=ct+Pt;Ct>0&&(pt?(Q-=Ct,rt==3?(nt+=Ct,L=!0):A=!0):(W-=Ct,rt==0?(St+=Ct,g=!0):M=!0))}}),Ti[0]=g,Ti[1]=A,Ti[2]=M,Ti[3]=L,Q-=T[1]+T[3],nt+=T[3],W-=T[2]+T[0],St+=T[0]}function ge(){let g=nt+Q,M=St+W,A=nt,L=St;function N(j,rt){switch(j){case 1:return g+=rt,g-rt;case 2:return M+=rt,M-rt;case 3:return A-=rt,A+rt;case 0:return L-=rt,L+rt}}E.forEach((j,rt)=>{if(j.show&&j._show){let ct=j.side;j._pos=N(ct,j._size),j.label!=null&&(j._lpos=N(ct,j.labelSize))}})}if(mt.dataIdx==null){let g=mt.hover,M=g.skip=new Set(g.skip??[]);M.add(void 0);let A=g.prox=ae(g.prox),L=g.bias??=0;mt.dataIdx=(N,j,rt,ct)=>{if(j==0)return rt;let pt=rt,Pt=A(N,j,rt,ct)??Ce,Ct=Pt>=0&&Pt<Ce,It=R.ori==0?Q:W,$t=mt.left,be=t[0],me=t[j];if(M.has(me[rt])){pt=null;let re=null,Xt=null,Vt;if(L==0||L==-1)for(Vt=rt;re==null&&Vt-- >0;)M.has(me[Vt])||(re=Vt);if(L==0||L==1)for(Vt=rt;Xt==null&&Vt++<me.length;)M.has(me[Vt])||(Xt=Vt);if(re!=null||Xt!=null)if(Ct){let Ue=re==null?-1/0:O(be[re],R,It,0),Ve=Xt==null?1/0:O(be[Xt],R,It,0),gn=$t-Ue,Ee=Ve-$t;gn<=Ee?gn<=Pt&&(pt=re):Ee<=Pt&&(pt=Xt)}else pt=Xt==null?re:re==null?Xt:rt-re<=Xt-rt?re:Xt}else Ct&&rn($t-O(be[rt],R,It,0))>Pt&&(pt=null);return pt}}const en=g=>{mt.event=g};mt.idxs=_t,mt._lock=!1;let Ie=mt.points;Ie.show=ae(Ie.show),Ie.size=ae(Ie.size),Ie.stroke=ae(Ie.stroke),Ie.width=ae(Ie.width),Ie.fill=ae(Ie.fill);const Wn=n.focus=Ke({},i.focus||{alpha:.3},mt.focus),zi=Wn.prox>=0,Bn=zi&&Ie.one;let yn=[],Vi=[],Hi=[];function Us(g,M){let A=Ie.show(n,M);if(A instanceof HTMLElement)return Zn(A,Bg),Zn(A,g.class),Fi(A,-10,-10,Q,W),_.insertBefore(A,yn[M]),A}function So(g,M){if(s==1||M>0){let A=s==1&&v[g.scale].time,L=g.value;g.value=A?Lf(L)?kf(J,Of(L,K)):L||ht:L||Q0,g.label=g.label||(A?X0:W0)}if(Bn||M>0){g.width=g.width==null?1:g.width,g.paths=g.paths||db||i0,g.fillTo=ae(g.fillTo||sb),g.pxAlign=+_e(g.pxAlign,b),g.pxRound=qf(g.pxAlign),g.stroke=ae(g.stroke||null),g.fill=ae(g.fill||null),g._stroke=g._fill=g._paths=g._focus=null;let A=tb(On(1,g.width),1),L=g.points=Ke({},{size:A,width:On(1,A*.2),stroke:g.stroke,space:A*2,paths:pb,_stroke:null,_fill:null},g.points);L.show=ae(L.show),L.filter=ae(L.filter),L.fill=ae(L.fill),L.stroke=ae(L.stroke),L.paths=ae(L.paths),L.pxAlign=g.pxAlign}if(st){let A=Gt(g,M);Ut.splice(M,0,A[0]),le.splice(M,0,A[1]),Mt.values.push(null)}if(lt){_t.splice(M,0,null);let A=null;Bn?M==0&&(A=Us(g,M)):M>0&&(A=Us(g,M)),yn.splice(M,0,A),Vi.splice(M,0,0),Hi.splice(M,0,0)}_n("addSeries",M)}function gr(g,M){M=M??S.length,g=s==1?fh(g,M,zf,Xf):fh(g,M,{},Wf),S.splice(M,0,g),So(S[M],M)}n.addSeries=gr;function ia(g){if(S.splice(g,1),st){Mt.values.splice(g,1),le.splice(g,1);let M=Ut.splice(g,1)[0];C(null,M.firstChild),M.remove()}lt&&(_t.splice(g,1),yn.splice(g,1)[0].remove(),Vi.splice(g,1),Hi.splice(g,1)),_n("delSeries",g)}n.delSeries=ia;const Ti=[!1,!1,!1,!1];function Gl(g,M){if(g._show=g.show,g.show){let A=g.side%2,L=v[g.scale];L==null&&(g.scale=A?S[1].scale:P,L=v[g.scale]);let N=L.time;g.size=ae(g.size),g.space=ae(g.space),g.rotate=ae(g.rotate),ws(g.incrs)&&g.incrs.forEach(rt=>{!Ps.has(rt)&&Ps.set(rt,Zp(rt))}),g.incrs=ae(g.incrs||(L.distr==2?E0:N?d==1?A0:C0:js)),g.splits=ae(g.splits||(N&&L.distr==1?et:L.distr==3?lh:L.distr==4?j0:q0)),g.stroke=ae(g.stroke),g.grid.stroke=ae(g.grid.stroke),g.ticks.stroke=ae(g.ticks.stroke),g.border.stroke=ae(g.border.stroke);let j=g.values;g.values=ws(j)&&!ws(j[0])?ae(j):N?ws(j)?Nf(J,Uf(j,K)):Lf(j)?F0(J,j):j||ft:j||Y0,g.filter=ae(g.filter||(L.distr>=3&&L.log==10?K0:L.distr==3&&L.log==2?J0:jp)),g.font=Kf(g.font),g.labelFont=Kf(g.labelFont),g._size=g.size(n,null,M,0),g._space=g._rotate=g._incrs=g._found=g._splits=g._values=null,g._size>0&&(Ti[M]=!0,g._el=ri(Ug,f))}}function Ns(g,M,A,L){let[N,j,rt,ct]=A,pt=M%2,Pt=0;return pt==0&&(ct||j)&&(Pt=M==0&&!N||M==2&&!rt?sn(Bf.size/3):0),pt==1&&(N||rt)&&(Pt=M==1&&!j||M==3&&!ct?sn(Hf.size/2):0),Pt}const sa=n.padding=(i.padding||[Ns,Ns,Ns,Ns]).map(g=>ae(_e(g,Ns))),T=n._padding=sa.map((g,M)=>g(n,M,Ti,0));let B,X=null,q=null;const H=s==1?S[0].idxs:null;let ut=null,yt=!1;function Ot(g,M){if(t=g??[],n.data=n._data=t,s==2){B=0;for(let A=1;A<S.length;A++)B+=t[A][0].length}else{t.length==0&&(n.data=n._data=t=[[]]),ut=t[0],B=ut.length;let A=t;if(G==2){A=t.slice();let L=A[0]=Array(B);for(let N=0;N<B;N++)L[N]=N}n._data=t=A}if(vr(!0),_n("setData"),G==2&&(de=!0),M!==!1){let A=R;A.auto(n,yt)?Ft():fs(P,A.min,A.max),z=z||mt.left>=0,it=!0,xr()}}n.setData=Ot;function Ft(){yt=!0;let g,M;s==1&&(B>0?(X=H[0]=0,q=H[1]=B-1,g=t[0][X],M=t[0][q],G==2?(g=X,M=q):g==M&&(G==3?[g,M]=Al(g,g,R.log,!1):G==4?[g,M]=du(g,g,R.log,!1):R.time?M=g+sn(86400/d):[g,M]=fl(g,M,pu,!0))):(X=H[0]=g=null,q=H[1]=M=null)),fs(P,g,M)}let Wt,Yt,Dt,oe,xe,Se,dn,he,Bt,ke;function pe(g,M,A,L,N,j){g??=pf,A??=_u,L??="butt",N??=pf,j??="round",g!=Wt&&(u.strokeStyle=Wt=g),N!=Yt&&(u.fillStyle=Yt=N),M!=Dt&&(u.lineWidth=Dt=M),j!=xe&&(u.lineJoin=xe=j),L!=Se&&(u.lineCap=Se=L),A!=oe&&u.setLineDash(oe=A)}function zn(g,M,A,L){M!=Yt&&(u.fillStyle=Yt=M),g!=dn&&(u.font=dn=g),A!=he&&(u.textAlign=he=A),L!=Bt&&(u.textBaseline=Bt=L)}function Ai(g,M,A,L,N=0){if(L.length>0&&g.auto(n,yt)&&(M==null||M.min==null)){let j=_e(X,0),rt=_e(q,L.length-1),ct=A.min==null?Kg(L,j,rt,N,g.distr==3):[A.min,A.max];g.min=Si(g.min,A.min=ct[0]),g.max=On(g.max,A.max=ct[1])}}const wn={min:null,max:null};function Os(){for(let L in v){let N=v[L];Y[L]==null&&(N.min==null||Y[P]!=null&&N.auto(n,yt))&&(Y[L]=wn)}for(let L in v){let N=v[L];Y[L]==null&&N.from!=null&&Y[N.from]!=null&&(Y[L]=wn)}Y[P]!=null&&vr(!0);let g={};for(let L in Y){let N=Y[L];if(N!=null){let j=g[L]=ao(v[L],o0);if(N.min!=null)Ke(j,N);else if(L!=P||s==2)if(B==0&&j.from==null){let rt=j.range(n,null,null,L);j.min=rt[0],j.max=rt[1]}else j.min=Ce,j.max=-Ce}}if(B>0){S.forEach((L,N)=>{if(s==1){let j=L.scale,rt=Y[j];if(rt==null)return;let ct=g[j];if(N==0){let pt=ct.range(n,ct.min,ct.max,j);ct.min=pt[0],ct.max=pt[1],X=Mi(ct.min,t[0]),q=Mi(ct.max,t[0]),q-X>1&&(t[0][X]<ct.min&&X++,t[0][q]>ct.max&&q--),L.min=ut[X],L.max=ut[q]}else L.show&&L.auto&&Ai(ct,rt,L,t[N],L.sorted);L.idxs[0]=X,L.idxs[1]=q}else if(N>0&&L.show&&L.auto){let[j,rt]=L.facets,ct=j.scale,pt=rt.scale,[Pt,Ct]=t[N],It=g[ct],$t=g[pt];It!=null&&Ai(It,Y[ct],j,Pt,j.sorted),$t!=null&&Ai($t,Y[pt],rt,Ct,rt.sorted),L.min=rt.min,L.max=rt.max}});for(let L in g){let N=g[L],j=Y[L];if(N.from==null&&(j==null||j.min==null)){let rt=N.range(n,N.min==Ce?null:N.min,N.max==-Ce?null:N.max,L);N.min=rt[0],N.max=rt[1]}}}for(let L in g){let N=g[L];if(N.from!=null){let j=g[N.from];if(j.min==null)N.min=N.max=null;else{let rt=N.range(n,j.min,j.max,L);N.min=rt[0],N.max=rt[1]}}}let M={},A=!1;for(let L in g){let N=g[L],j=v[L];if(j.min!=N.min||j.max!=N.max){j.min=N.min,j.max=N.max;let rt=j.distr;j._min=rt==3?is(j.min):rt==4?rc(j.min,j.asinh):rt==100?j.fwd(j.min):j.min,j._max=rt==3?is(j.max):rt==4?rc(j.max,j.asinh):rt==100?j.fwd(j.max):j.max,M[L]=A=!0}}if(A){S.forEach((L,N)=>{s==2?N>0&&M.y&&(L._paths=null):M[L.scale]&&(L._paths=null)});for(let L in M)de=!0,_n("setScale",L);lt&&mt.left>=0&&(z=it=!0)}for(let L in Y)Y[L]=null}function Pe(g){let M=ah(X-1,0,B-1),A=ah(q+1,0,B-1);for(;g[M]==null&&M>0;)M--;for(;g[A]==null&&A<B-1;)A++;return[M,A]}function ti(){if(B>0){let g=S.some(M=>M._focus)&&ke!=Wn.alpha;g&&(u.globalAlpha=ke=Wn.alpha),S.forEach((M,A)=>{if(A>0&&M.show&&(hs(A,!1),hs(A,!0),M._paths==null)){let L=ke;ke!=M.alpha&&(u.globalAlpha=ke=M.alpha);let N=s==2?[0,t[A][0].length-1]:Pe(t[A]);M._paths=M.paths(n,A,N[0],N[1]),ke!=L&&(u.globalAlpha=ke=L)}}),S.forEach((M,A)=>{if(A>0&&M.show){let L=ke;ke!=M.alpha&&(u.globalAlpha=ke=M.alpha),M._paths!=null&&Ln(A,!1);{let N=M._paths!=null?M._paths.gaps:null,j=M.points.show(n,A,X,q,N),rt=M.points.filter(n,A,j,N);(j||rt)&&(M.points._paths=M.points.paths(n,A,X,q,rt),Ln(A,!0))}ke!=L&&(u.globalAlpha=ke=L),_n("drawSeries",A)}}),g&&(u.globalAlpha=ke=1)}}function hs(g,M){let A=M?S[g].points:S[g];A._stroke=A.stroke(n,g),A._fill=A.fill(n,g)}function Ln(g,M){let A=M?S[g].points:S[g],{stroke:L,fill:N,clip:j,flags:rt,_stroke:ct=A._stroke,_fill:pt=A._fill,_width:Pt=A.width}=A._paths;Pt=Le(Pt*ve,3);let Ct=null,It=Pt%2/2;M&&pt==null&&(pt=Pt>0?"#fff":ct);let $t=A.pxAlign==1&&It>0;if($t&&u.translate(It,It),!M){let be=vt-Pt/2,me=Nt-Pt/2,re=kt+Pt,Xt=wt+Pt;Ct=new Path2D,Ct.rect(be,me,re,Xt)}M?br(ct,Pt,A.dash,A.cap,pt,L,N,rt,j):Ri(g,ct,Pt,A.dash,A.cap,pt,L,N,rt,Ct,j),$t&&u.translate(-It,-It)}function Ri(g,M,A,L,N,j,rt,ct,pt,Pt,Ct){let It=!1;pt!=0&&U.forEach(($t,be)=>{if($t.series[0]==g){let me=S[$t.series[1]],re=t[$t.series[1]],Xt=(me._paths||Xo).band;ws(Xt)&&(Xt=$t.dir==1?Xt[0]:Xt[1]);let Vt,Ue=null;me.show&&Xt&&Qg(re,X,q)?(Ue=$t.fill(n,be)||j,Vt=me._paths.clip):Xt=null,br(M,A,L,N,Ue,rt,ct,pt,Pt,Ct,Vt,Xt),It=!0}}),It||br(M,A,L,N,j,rt,ct,pt,Pt,Ct)}const ui=lo|hh;function br(g,M,A,L,N,j,rt,ct,pt,Pt,Ct,It){pe(g,M,A,L,N),(pt||Pt||It)&&(u.save(),pt&&u.clip(pt),Pt&&u.clip(Pt)),It?(ct&ui)==ui?(u.clip(It),Ct&&u.clip(Ct),oa(N,rt),ra(g,j,M)):ct&hh?(oa(N,rt),u.clip(It),ra(g,j,M)):ct&lo&&(u.save(),u.clip(It),Ct&&u.clip(Ct),oa(N,rt),u.restore(),ra(g,j,M)):(oa(N,rt),ra(g,j,M)),(pt||Pt||It)&&u.restore()}function ra(g,M,A){A>0&&(M instanceof Map?M.forEach((L,N)=>{u.strokeStyle=Wt=N,u.stroke(L)}):M!=null&&g&&u.stroke(M))}function oa(g,M){M instanceof Map?M.forEach((A,L)=>{u.fillStyle=Yt=L,u.fill(A)}):M!=null&&g&&u.fill(M)}function w_(g,M,A,L){let N=E[g],j;if(L<=0)j=[0,0];else{let rt=N._space=N.space(n,g,M,A,L),ct=N._incrs=N.incrs(n,g,M,A,L,rt);j=xb(M,A,ct,L,rt)}return N._found=j}function Wl(g,M,A,L,N,j,rt,ct,pt,Pt){let Ct=rt%2/2;b==1&&u.translate(Ct,Ct),pe(ct,rt,pt,Pt,ct),u.beginPath();let It,$t,be,me,re=N+(L==0||L==3?-j:j);A==0?($t=N,me=re):(It=N,be=re);for(let Xt=0;Xt<g.length;Xt++)M[Xt]!=null&&(A==0?It=be=g[Xt]:$t=me=g[Xt],u.moveTo(It,$t),u.lineTo(be,me));u.stroke(),b==1&&u.translate(-Ct,-Ct)}function E_(g){let M=!0;return E.forEach((A,L)=>{if(!A.show)return;let N=v[A.scale];if(N.min==null){A._show&&(M=!1,A._show=!1,vr(!1));return}else A._show||(M=!1,A._show=!0,vr(!1));let j=A.side,rt=j%2,{min:ct,max:pt}=N,[Pt,Ct]=w_(L,ct,pt,rt==0?Q:W);if(Ct==0)return;let It=N.distr==2,$t=A._splits=A.splits(n,L,ct,pt,Pt,Ct,It),be=N.distr==2?$t.map(Vt=>ut[Vt]):$t,me=N.distr==2?ut[$t[1]]-ut[$t[0]]:Pt,re=A._values=A.values(n,A.filter(n,be,L,Ct,me),L,Ct,me);A._rotate=j==2?A.rotate(n,re,L,Ct):0;let Xt=A._size;A._size=oi(A.size(n,re,L,g)),Xt!=null&&A._size!=Xt&&(M=!1)}),M}function T_(g){let M=!0;return sa.forEach((A,L)=>{let N=A(n,L,Ti,g);N!=T[L]&&(M=!1),T[L]=N}),M}function A_(){for(let g=0;g<E.length;g++){let M=E[g];if(!M.show||!M._show)continue;let A=M.side,L=A%2,N,j,rt=M.stroke(n,g),ct=A==0||A==3?-1:1,[pt,Pt]=M._found;if(M.label!=null){let Fn=M.labelGap*ct,qn=sn((M._lpos+Fn)*ve);zn(M.labelFont[0],rt,"center",A==2?Ro:df),u.save(),L==1?(N=j=0,u.translate(qn,sn(Nt+wt/2)),u.rotate((A==3?-Xa:Xa)/2)):(N=sn(vt+kt/2),j=qn);let zs=Yp(M.label)?M.label(n,g,pt,Pt):M.label;u.fillText(zs,N,j),u.restore()}if(Pt==0)continue;let Ct=v[M.scale],It=L==0?kt:wt,$t=L==0?vt:Nt,be=M._splits,me=Ct.distr==2?be.map(Fn=>ut[Fn]):be,re=Ct.distr==2?ut[be[1]]-ut[be[0]]:pt,Xt=M.ticks,Vt=M.border,Ue=Xt.show?Xt.size:0,Ve=sn(Ue*ve),gn=sn((M.alignTo==2?M._size-Ue-M.gap:M.gap)*ve),Ee=M._rotate*-Xa/180,He=m(M._pos*ve),Xn=(Ve+gn)*ct,In=He+Xn;j=L==0?In:0,N=L==1?In:0;let ei=M.font[0],fi=M.align==1?Rr:M.align==2?nc:Ee>0?Rr:Ee<0?nc:L==0?"center":A==3?nc:Rr,Li=Ee||L==1?"middle":A==2?Ro:df;zn(ei,rt,fi,Li);let Yn=M.font[1]*M.lineGap,ni=be.map(Fn=>m(a(Fn,Ct,It,$t))),di=M._values;for(let Fn=0;Fn<di.length;Fn++){let qn=di[Fn];if(qn!=null){L==0?N=ni[Fn]:j=ni[Fn],qn=""+qn;let zs=qn.indexOf(`
`)==-1?[qn]:qn.split(/\n/gm);for(let Dn=0;Dn<zs.length;Dn++){let af=zs[Dn];Ee?(u.save(),u.translate(N,j+Dn*Yn),u.rotate(Ee),u.fillText(af,0,0),u.restore()):u.fillText(af,N,j+Dn*Yn)}}}Xt.show&&Wl(ni,Xt.filter(n,me,g,Pt,re),L,A,He,Ve,Le(Xt.width*ve,3),Xt.stroke(n,g),Xt.dash,Xt.cap);let Ii=M.grid;Ii.show&&Wl(ni,Ii.filter(n,me,g,Pt,re),L,L==0?2:1,L==0?Nt:vt,L==0?wt:kt,Le(Ii.width*ve,3),Ii.stroke(n,g),Ii.dash,Ii.cap),Vt.show&&Wl([He],[1],L==0?1:0,L==0?1:2,L==1?Nt:vt,L==1?wt:kt,Le(Vt.width*ve,3),Vt.stroke(n,g),Vt.dash,Vt.cap)}_n("drawAxes")}function vr(g){S.forEach((M,A)=>{A>0&&(M._paths=null,g&&(s==1?(M.min=null,M.max=null):M.facets.forEach(L=>{L.min=null,L.max=null})))})}let aa=!1,Xl=!1,yo=[];function R_(){Xl=!1;for(let g=0;g<yo.length;g++)_n(...yo[g]);yo.length=0}function xr(){aa||(d0(Hu),aa=!0)}function P_(g,M=!1){aa=!0,Xl=M,g(n),Hu(),M&&yo.length>0&&queueMicrotask(R_)}n.batch=P_;function Hu(){if(se&&(Os(),se=!1),de&&(Jt(),de=!1),jt){if(Ne(p,Rr,nt),Ne(p,Ro,St),Ne(p,Bo,Q),Ne(p,zo,W),Ne(_,Rr,nt),Ne(_,Ro,St),Ne(_,Bo,Q),Ne(_,zo,W),Ne(f,Bo,y),Ne(f,zo,Z),h.width=sn(y*ve),h.height=sn(Z*ve),E.forEach(({_el:g,_show:M,_size:A,_pos:L,side:N})=>{if(g!=null)if(M){let j=N===3||N===0?A:0,rt=N%2==1;Ne(g,rt?"left":"top",L-j),Ne(g,rt?"width":"height",A),Ne(g,rt?"top":"left",rt?St:nt),Ne(g,rt?"height":"width",rt?W:Q),rh(g,nr)}else Zn(g,nr)}),Wt=Yt=Dt=xe=Se=dn=he=Bt=oe=null,ke=1,To(!0),nt!=bt||St!=Tt||Q!=Zt||W!=dt){vr(!1);let g=Q/Zt,M=W/dt;if(lt&&!z&&mt.left>=0){mt.left*=g,mt.top*=M,Mr&&Fi(Mr,sn(mt.left),0,Q,W),Sr&&Fi(Sr,0,sn(mt.top),Q,W);for(let A=0;A<yn.length;A++){let L=yn[A];L!=null&&(Vi[A]*=g,Hi[A]*=M,Fi(L,oi(Vi[A]),oi(Hi[A]),Q,W))}}if(De.show&&!xt&&De.left>=0&&De.width>0){De.left*=g,De.width*=g,De.top*=M,De.height*=M;for(let A in Kl)Ne(Er,A,De[A])}bt=nt,Tt=St,Zt=Q,dt=W}_n("setSize"),jt=!1}y>0&&Z>0&&(u.clearRect(0,0,h.width,h.height),_n("drawClear"),F.forEach(g=>g()),_n("draw")),De.show&&xt&&(la(De),xt=!1),lt&&z&&(Bs(null,!0,!1),z=!1),Mt.show&&Mt.live&&it&&($l(),it=!1),l||(l=!0,n.status=1,_n("ready")),yt=!1,aa=!1}n.redraw=(g,M)=>{de=M||!1,g!==!1?fs(P,R.min,R.max):xr()};function Yl(g,M){let A=v[g];if(A.from==null){if(B==0){let L=A.range(n,M.min,M.max,g);M.min=L[0],M.max=L[1]}if(M.min>M.max){let L=M.min;M.min=M.max,M.max=L}if(B>1&&M.min!=null&&M.max!=null&&M.max-M.min<1e-16)return;g==P&&A.distr==2&&B>0&&(M.min=Mi(M.min,t[0]),M.max=Mi(M.max,t[0]),M.min==M.max&&M.max++),Y[g]=M,se=!0,xr()}}n.setScale=Yl;let ql,jl,Mr,Sr,Gu,Wu,yr,wr,Xu,Yu,Fe,Be,us=!1;const Mn=mt.drag;let pn=Mn.x,mn=Mn.y;lt&&(mt.x&&(ql=ri(Og,_)),mt.y&&(jl=ri(kg,_)),R.ori==0?(Mr=ql,Sr=jl):(Mr=jl,Sr=ql),Fe=mt.left,Be=mt.top);const De=n.select=Ke({show:!0,over:!0,left:0,width:0,top:0,height:0},i.select),Er=De.show?ri(Ng,De.over?_:p):null;function la(g,M){if(De.show){for(let A in g)De[A]=g[A],A in Kl&&Ne(Er,A,g[A]);M!==!1&&_n("setSelect")}}n.setSelect=la;function C_(g){if(S[g].show)st&&rh(Ut[g],nr);else if(st&&Zn(Ut[g],nr),lt){let A=Bn?yn[0]:yn[g];A!=null&&Fi(A,-10,-10,Q,W)}}function fs(g,M,A){Yl(g,{min:M,max:A})}function Pi(g,M,A,L){M.focus!=null&&U_(g),M.show!=null&&S.forEach((N,j)=>{j>0&&(g==j||g==null)&&(N.show=M.show,C_(j),s==2?(fs(N.facets[0].scale,null,null),fs(N.facets[1].scale,null,null)):fs(N.scale,null,null),xr())}),A!==!1&&_n("setSeries",g,M),L&&Ao("setSeries",n,g,M)}n.setSeries=Pi;function L_(g,M){Ke(U[g],M)}function I_(g,M){g.fill=ae(g.fill||null),g.dir=_e(g.dir,-1),M=M??U.length,U.splice(M,0,g)}function F_(g){g==null?U.length=0:U.splice(g,1)}n.addBand=I_,n.setBand=L_,n.delBand=F_;function D_(g,M){S[g].alpha=M,lt&&yn[g]!=null&&(yn[g].style.opacity=M),st&&Ut[g]&&(Ut[g].style.opacity=M)}let Gi,ds,ks;const Tr={focus:!0};function U_(g){if(g!=ks){let M=g==null,A=Wn.alpha!=1;S.forEach((L,N)=>{if(s==1||N>0){let j=M||N==0||N==g;L._focus=M?null:j,A&&D_(N,j?1:Wn.alpha)}}),ks=g,A&&xr()}}st&&zi&&Lt(gf,at,g=>{mt._lock||(en(g),ks!=null&&Pi(null,Tr,!0,qe.setSeries))});function Ci(g,M,A){let L=v[M];A&&(g=g/ve-(L.ori==1?St:nt));let N=Q;L.ori==1&&(N=W,g=N-g),L.dir==-1&&(g=N-g);let j=L._min,rt=L._max,ct=g/N,pt=j+(rt-j)*ct,Pt=L.distr;return Pt==3?ro(10,pt):Pt==4?e0(pt,L.asinh):Pt==100?L.bwd(pt):pt}function N_(g,M){let A=Ci(g,P,M);return Mi(A,t[0],X,q)}n.valToIdx=g=>Mi(g,t[0]),n.posToIdx=N_,n.posToVal=Ci,n.valToPos=(g,M,A)=>v[M].ori==0?r(g,v[M],A?kt:Q,A?vt:0):o(g,v[M],A?wt:W,A?Nt:0),n.setCursor=(g,M,A)=>{Fe=g.left,Be=g.top,Bs(null,M,A)};function qu(g,M){Ne(Er,Rr,De.left=g),Ne(Er,Bo,De.width=M)}function ju(g,M){Ne(Er,Ro,De.top=g),Ne(Er,zo,De.height=M)}let wo=R.ori==0?qu:ju,Eo=R.ori==1?qu:ju;function O_(){if(st&&Mt.live)for(let g=s==2?1:0;g<S.length;g++){if(g==0&&ce)continue;let M=Mt.values[g],A=0;for(let L in M)le[g][A++].firstChild.nodeValue=M[L]}}function $l(g,M){if(g!=null&&(g.idxs?g.idxs.forEach((A,L)=>{_t[L]=A}):r0(g.idx)||_t.fill(g.idx),Mt.idx=_t[0]),st&&Mt.live){for(let A=0;A<S.length;A++)(A>0||s==1&&!ce)&&k_(A,_t[A]);O_()}it=!1,M!==!1&&_n("setLegend")}n.setLegend=$l;function k_(g,M){let A=S[g],L=g==0&&G==2?ut:t[g],N;ce?N=A.values(n,g,M)??V:(N=A.value(n,M==null?null:L[M],g,M),N=N==null?V:{_:N}),Mt.values[g]=N}function Bs(g,M,A){Xu=Fe,Yu=Be,[Fe,Be]=mt.move(n,Fe,Be),mt.left=Fe,mt.top=Be,lt&&(Mr&&Fi(Mr,sn(Fe),0,Q,W),Sr&&Fi(Sr,0,sn(Be),Q,W));let L,N=X>q;Gi=Ce,ds=null;let j=R.ori==0?Q:W,rt=R.ori==1?Q:W;if(Fe<0||B==0||N){L=mt.idx=null;for(let ct=0;ct<S.length;ct++){let pt=yn[ct];pt!=null&&Fi(pt,-10,-10,Q,W)}zi&&Pi(null,Tr,!0,g==null&&qe.setSeries),Mt.live&&(_t.fill(L),it=!0)}else{let ct,pt,Pt;s==1&&(ct=R.ori==0?Fe:Be,pt=Ci(ct,P),L=mt.idx=Mi(pt,t[0],X,q),Pt=O(t[0][L],R,j,0));let Ct=-10,It=-10,$t=0,be=0,me=!0,re="",Xt="";for(let Vt=s==2?1:0;Vt<S.length;Vt++){let Ue=S[Vt],Ve=_t[Vt],gn=Ve==null?null:s==1?t[Vt][Ve]:t[Vt][1][Ve],Ee=mt.dataIdx(n,Vt,L,pt),He=Ee==null?null:s==1?t[Vt][Ee]:t[Vt][1][Ee];if(it=it||He!=gn||Ee!=Ve,_t[Vt]=Ee,Vt>0&&Ue.show){let Xn=Ee==null?-10:Ee==L?Pt:O(s==1?t[0][Ee]:t[Vt][0][Ee],R,j,0),In=He==null?-10:$(He,s==1?v[Ue.scale]:v[Ue.facets[1].scale],rt,0);if(zi&&He!=null){let ei=R.ori==1?Fe:Be,fi=rn(Wn.dist(n,Vt,Ee,In,ei));if(fi<Gi){let Li=Wn.bias;if(Li!=0){let Yn=Ci(ei,Ue.scale),ni=He>=0?1:-1,di=Yn>=0?1:-1;di==ni&&(di==1?Li==1?He>=Yn:He<=Yn:Li==1?He<=Yn:He>=Yn)&&(Gi=fi,ds=Vt)}else Gi=fi,ds=Vt}}if(it||Bn){let ei,fi;R.ori==0?(ei=Xn,fi=In):(ei=In,fi=Xn);let Li,Yn,ni,di,Ii,Fn,qn=!0,zs=Ie.bbox;if(zs!=null){qn=!1;let Dn=zs(n,Vt);ni=Dn.left,di=Dn.top,Li=Dn.width,Yn=Dn.height}else ni=ei,di=fi,Li=Yn=Ie.size(n,Vt);if(Fn=Ie.fill(n,Vt),Ii=Ie.stroke(n,Vt),Bn)Vt==ds&&Gi<=Wn.prox&&(Ct=ni,It=di,$t=Li,be=Yn,me=qn,re=Fn,Xt=Ii);else{let Dn=yn[Vt];Dn!=null&&(Vi[Vt]=ni,Hi[Vt]=di,wf(Dn,Li,Yn,qn),Sf(Dn,Fn,Ii),Fi(Dn,oi(ni),oi(di),Q,W))}}}}if(Bn){let Vt=Wn.prox,Ue=ks==null?Gi<=Vt:Gi>Vt||ds!=ks;if(it||Ue){let Ve=yn[0];Ve!=null&&(Vi[0]=Ct,Hi[0]=It,wf(Ve,$t,be,me),Sf(Ve,re,Xt),Fi(Ve,oi(Ct),oi(It),Q,W))}}}if(De.show&&us)if(g!=null){let[ct,pt]=qe.scales,[Pt,Ct]=qe.match,[It,$t]=g.cursor.sync.scales,be=g.cursor.drag;if(pn=be._x,mn=be._y,pn||mn){let{left:me,top:re,width:Xt,height:Vt}=g.select,Ue=g.scales[It].ori,Ve=g.posToVal,gn,Ee,He,Xn,In,ei=ct!=null&&Pt(ct,It),fi=pt!=null&&Ct(pt,$t);ei&&pn?(Ue==0?(gn=me,Ee=Xt):(gn=re,Ee=Vt),He=v[ct],Xn=O(Ve(gn,It),He,j,0),In=O(Ve(gn+Ee,It),He,j,0),wo(Si(Xn,In),rn(In-Xn))):wo(0,j),fi&&mn?(Ue==1?(gn=me,Ee=Xt):(gn=re,Ee=Vt),He=v[pt],Xn=$(Ve(gn,$t),He,rt,0),In=$(Ve(gn+Ee,$t),He,rt,0),Eo(Si(Xn,In),rn(In-Xn))):Eo(0,rt)}else Jl()}else{let ct=rn(Xu-Gu),pt=rn(Yu-Wu);if(R.ori==1){let $t=ct;ct=pt,pt=$t}pn=Mn.x&&ct>=Mn.dist,mn=Mn.y&&pt>=Mn.dist;let Pt=Mn.uni;Pt!=null?pn&&mn&&(pn=ct>=Pt,mn=pt>=Pt,!pn&&!mn&&(pt>ct?mn=!0:pn=!0)):Mn.x&&Mn.y&&(pn||mn)&&(pn=mn=!0);let Ct,It;pn&&(R.ori==0?(Ct=yr,It=Fe):(Ct=wr,It=Be),wo(Si(Ct,It),rn(It-Ct)),mn||Eo(0,rt)),mn&&(R.ori==1?(Ct=yr,It=Fe):(Ct=wr,It=Be),Eo(Si(Ct,It),rn(It-Ct)),pn||wo(0,j)),!pn&&!mn&&(wo(0,0),Eo(0,0))}if(Mn._x=pn,Mn._y=mn,g==null){if(A){if(of!=null){let[ct,pt]=qe.scales;qe.values[0]=ct!=null?Ci(R.ori==0?Fe:Be,ct):null,qe.values[1]=pt!=null?Ci(R.ori==1?Fe:Be,pt):null}Ao(ic,n,Fe,Be,Q,W,L)}if(zi){let ct=A&&qe.setSeries,pt=Wn.prox;ks==null?Gi<=pt&&Pi(ds,Tr,!0,ct):Gi>pt?Pi(null,Tr,!0,ct):ds!=ks&&Pi(ds,Tr,!0,ct)}}it&&(Mt.idx=L,$l()),M!==!1&&_n("setCursor")}let ps=null;Object.defineProperty(n,"rect",{get(){return ps==null&&To(!1),ps}});function To(g=!1){g?ps=null:(ps=_.getBoundingClientRect(),_n("syncRect",ps))}function $u(g,M,A,L,N,j,rt){mt._lock||us&&g!=null&&g.movementX==0&&g.movementY==0||(Zl(g,M,A,L,N,j,rt,!1,g!=null),g!=null?Bs(null,!0,!0):Bs(M,!0,!1))}function Zl(g,M,A,L,N,j,rt,ct,pt){if(ps==null&&To(!1),en(g),g!=null)A=g.clientX-ps.left,L=g.clientY-ps.top;else{if(A<0||L<0){Fe=-10,Be=-10;return}let[Pt,Ct]=qe.scales,It=M.cursor.sync,[$t,be]=It.values,[me,re]=It.scales,[Xt,Vt]=qe.match,Ue=M.axes[0].side%2==1,Ve=R.ori==0?Q:W,gn=R.ori==1?Q:W,Ee=Ue?j:N,He=Ue?N:j,Xn=Ue?L:A,In=Ue?A:L;if(me!=null?A=Xt(Pt,me)?a($t,v[Pt],Ve,0):-10:A=Ve*(Xn/Ee),re!=null?L=Vt(Ct,re)?a(be,v[Ct],gn,0):-10:L=gn*(In/He),R.ori==1){let ei=A;A=L,L=ei}}pt&&(M==null||M.cursor.event.type==ic)&&((A<=1||A>=Q-1)&&(A=qs(A,Q)),(L<=1||L>=W-1)&&(L=qs(L,W))),ct?(Gu=A,Wu=L,[yr,wr]=mt.move(n,A,L)):(Fe=A,Be=L)}const Kl={width:0,height:0,left:0,top:0};function Jl(){la(Kl,!1)}let Zu,Ku,Ju,Qu;function tf(g,M,A,L,N,j,rt){us=!0,pn=mn=Mn._x=Mn._y=!1,Zl(g,M,A,L,N,j,rt,!0,!1),g!=null&&(Lt(sc,ih,ef,!1),Ao(mf,n,yr,wr,Q,W,null));let{left:ct,top:pt,width:Pt,height:Ct}=De;Zu=ct,Ku=pt,Ju=Pt,Qu=Ct}function ef(g,M,A,L,N,j,rt){us=Mn._x=Mn._y=!1,Zl(g,M,A,L,N,j,rt,!1,!0);let{left:ct,top:pt,width:Pt,height:Ct}=De,It=Pt>0||Ct>0,$t=Zu!=ct||Ku!=pt||Ju!=Pt||Qu!=Ct;if(It&&$t&&la(De),Mn.setScale&&It&&$t){let be=ct,me=Pt,re=pt,Xt=Ct;if(R.ori==1&&(be=pt,me=Ct,re=ct,Xt=Pt),pn&&fs(P,Ci(be,P),Ci(be+me,P)),mn)for(let Vt in v){let Ue=v[Vt];Vt!=P&&Ue.from==null&&Ue.min!=Ce&&fs(Vt,Ci(re+Xt,Vt),Ci(re,Vt))}Jl()}else mt.lock&&(mt._lock=!mt._lock,Bs(M,!0,g!=null));g!=null&&(C(sc,ih),Ao(sc,n,Fe,Be,Q,W,null))}function B_(g,M,A,L,N,j,rt){if(mt._lock)return;en(g);let ct=us;if(us){let pt=!0,Pt=!0,Ct=10,It,$t;R.ori==0?(It=pn,$t=mn):(It=mn,$t=pn),It&&$t&&(pt=Fe<=Ct||Fe>=Q-Ct,Pt=Be<=Ct||Be>=W-Ct),It&&pt&&(Fe=Fe<yr?0:Q),$t&&Pt&&(Be=Be<wr?0:W),Bs(null,!0,!0),us=!1}Fe=-10,Be=-10,_t.fill(null),Bs(null,!0,!0),ct&&(us=ct)}function nf(g,M,A,L,N,j,rt){mt._lock||(en(g),Ft(),Jl(),g!=null&&Ao(bf,n,Fe,Be,Q,W,null))}function sf(){E.forEach(Mb),ot(n.width,n.height,!0)}lr(ul,Jr,sf);const Ar={};Ar.mousedown=tf,Ar.mousemove=$u,Ar.mouseup=ef,Ar.dblclick=nf,Ar.setSeries=(g,M,A,L)=>{let N=qe.match[2];A=N(n,M,A),A!=-1&&Pi(A,L,!0,!1)},lt&&(Lt(mf,_,tf),Lt(ic,_,$u),Lt(_f,_,g=>{en(g),To(!1)}),Lt(gf,_,B_),Lt(bf,_,nf),uh.add(n),n.syncRect=To);const ca=n.hooks=i.hooks||{};function _n(g,M,A){Xl?yo.push([g,M,A]):g in ca&&ca[g].forEach(L=>{L.call(null,n,M,A)})}(i.plugins||[]).forEach(g=>{for(let M in g.hooks)ca[M]=(ca[M]||[]).concat(g.hooks[M])});const rf=(g,M,A)=>A,qe=Ke({key:null,setSeries:!1,filters:{pub:Pf,sub:Pf},scales:[P,S[1]?S[1].scale:null],match:[Cf,Cf,rf],values:[null,null]},mt.sync);qe.match.length==2&&qe.match.push(rf),mt.sync=qe;const of=qe.key,Ql=_m(of);function Ao(g,M,A,L,N,j,rt){qe.filters.pub(g,M,A,L,N,j,rt)&&Ql.pub(g,M,A,L,N,j,rt)}Ql.sub(n);function z_(g,M,A,L,N,j,rt){qe.filters.sub(g,M,A,L,N,j,rt)&&Ar[g](null,M,A,L,N,j,rt)}n.pub=z_;function V_(){Ql.unsub(n),uh.delete(n),fe.clear(),oh(ul,Jr,sf),c.remove(),at?.remove(),_n("destroy")}n.destroy=V_;function tc(){_n("init",i,t),Ot(t||i.data,!1),Y[P]?Yl(P,Y[P]):Ft(),xt=De.show&&(De.width>0||De.height>0),z=it=!0,ot(i.width,i.height)}return S.forEach(So),E.forEach(Gl),e?e instanceof HTMLElement?(e.appendChild(c),tc()):e(n,tc):tc(),n}ln.assign=Ke;ln.fmtNum=mu;ln.rangeNum=fl;ln.rangeLog=Al;ln.rangeAsinh=du;ln.orient=dr;ln.pxRatio=ve;ln.join=f0;ln.fmtDate=gu,ln.tzDate=y0;ln.sync=_m;{ln.addGap=rb,ln.clipGaps=Cl;let i=ln.paths={points:Sm};i.linear=wm,i.stepped=lb,i.bars=cb,i.spline=ub}const Rm='system-ui, "DejaVu Sans", sans-serif',pl="#1d2733",Jf="#dde3ea",Qf=i=>i.replace(/[&<>"]/g,t=>({"&":"&amp;","<":"&lt;",">":"&gt;",'"':"&quot;"})[t]??t);class Sb{constructor(){this.parts=[]}line(t,e,n,s){const r=t.map(l=>l.toFixed(2)),o=r.flatMap((l,c)=>c%2===0?[`${l},${r[c+1]}`]:[]),a=s.length>0?` stroke-dasharray="${s.join(" ")}"`:"";this.parts.push(`<polyline points="${o.join(" ")}" fill="none" stroke="${e}" stroke-width="${n}" stroke-linejoin="round"${a}/>`)}box(t,e,n,s,r){const o=`x="${t.toFixed(2)}" y="${e.toFixed(2)}"`,a=`width="${n.toFixed(2)}" height="${s.toFixed(2)}"`;this.parts.push(`<rect ${o} ${a} fill="${r}"/>`)}text(t,e,n,s,r){const o=`x="${t.toFixed(2)}" y="${e.toFixed(2)}"`;this.parts.push(`<text ${o} font-size="${s}" text-anchor="${r}">${Qf(n)}</text>`)}turnedText(t,e,n,s){const r=`transform="translate(${t} ${e}) rotate(-90)"`;this.parts.push(`<text ${r} font-size="${s}" text-anchor="middle">${Qf(n)}</text>`)}finish(t,e){return`<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${t} ${e}" width="${t}" height="${e}" font-family='${Rm}' fill="${pl}">
${this.parts.join(`
`)}
</svg>
`}}class yb{constructor(t){this.context=t}line(t,e,n,s){const r=this.context;r.strokeStyle=e,r.lineWidth=n,r.lineJoin="round",r.setLineDash(s),r.beginPath();for(let o=0;o<t.length;o+=2)r.lineTo(t[o],t[o+1]);r.stroke()}box(t,e,n,s,r){this.context.fillStyle=r,this.context.fillRect(t,e,n,s)}text(t,e,n,s,r){const o=this.context;o.font=`${s}px ${Rm}`,o.textAlign=r==="middle"?"center":r,o.fillStyle=pl,o.fillText(n,t,e)}turnedText(t,e,n,s){this.context.save(),this.context.translate(t,e),this.context.rotate(-Math.PI/2),this.text(0,0,n,s,"middle"),this.context.restore()}}function ml(i,t,e){const n=(t-i)/e;if(!(n>0))return[i];const s=10**Math.floor(Math.log10(n)),r=[1,2,5,10].map(a=>a*s).find(a=>a>=n)??10*s,o=[];for(let a=Math.ceil(i/r-1e-9);a*r<=t+1e-9*r;++a)o.push(Number((a*r).toPrecision(12)));return o}function Pm(i){let[t,e]=[0,0];for(const s of i)for(const r of s)r<t&&(t=r),r>e&&(e=r);t===e&&(e=t+1);const n=.06*(e-t);return[t===0?0:t-n,e===0?0:e+n]}function dh(i){let[t,e]=[1/0,-1/0];for(const{xs:n}of i.curves)for(const s of n)s<t&&(t=s),s>e&&(e=s);return t<e?[t,e]:[0,1]}function Cm(i,t,e,n){const[s,r,o,a]=[64,20,64,48],[l,c]=[e-s-r,n-o-a],[h,u]=dh(i),[f,p]=Pm(i.curves.map(d=>d.ys)),_=d=>s+(d-h)/(u-h)*l,b=d=>o+(p-d)/(p-f)*c;t.box(0,0,e,n,"#ffffff"),t.text(s,24,i.title,16,"start"),i.bands.forEach((d,S)=>{const[E,v]=[_(Math.max(h,d.from)),_(Math.min(u,d.to))];v<=E||(t.box(E,o,v-E,c,S%2===0?"#f3f5f8":"#e8ecf1"),v-E>40&&t.text((E+v)/2,o+c-6,d.label,11,"middle"))});for(const d of ml(h,u,8))t.line([_(d),o,_(d),o+c],Jf,1,[]),t.text(_(d),o+c+18,String(d),12,"middle");for(const d of ml(f,p,6))t.line([s,b(d),s+l,b(d)],Jf,1,[]),t.text(s-8,b(d)+4,String(d),12,"end");t.line([s,o,s,o+c,s+l,o+c],pl,1,[]);for(const d of i.marks)d.x<h||d.x>u||(t.line([_(d.x),o,_(d.x),o+c],pl,1,d.strong?[]:[2,3]),t.text(_(d.x)+3,o+12,d.label,11,"start"));for(const d of i.curves){const S=d.xs.flatMap((E,v)=>[_(E),b(d.ys[v])]);t.line(S,d.colour,d.width,d.dash)}let m=s;for(const d of i.curves)t.line([m,46,m+26,46],d.colour,d.width,d.dash),t.text(m+31,50,d.name,12,"start"),m+=44+7*d.name.length;t.text(s+l/2,n-10,i.xLabel,13,"middle"),t.turnedText(18,o+c/2,i.yLabel,13)}const _l=960,gl=480;function wb(i){const t=new Sb;return Cm(i,t,_l,gl),t.finish(_l,gl)}function Lm(i,t=2){const e=document.createElement("canvas");e.width=_l*t,e.height=gl*t;const n=e.getContext("2d");return n!==null&&(n.scale(t,t),Cm(i,new yb(n),_l,gl)),e}function Eb(i,t,e){const n=[i.join(",")];for(let s=0;s<(t[0]?.length??0);++s)n.push(t.map(r=>e(r[s])).join(","));return`${n.join(`
`)}
`}const td=110,Tb=20,Ab=.6;class ed{constructor(t){this.name=t,this.place=tt("div",{class:"plot-place"}),this.summary=tt("p",{class:"quiet-text"}),this.u=null,this.root=tt("div",{class:"plot"},this.place,this.summary),new ResizeObserver(()=>{const e=this.place.clientWidth;this.u!==null&&e>0&&this.u.setSize({width:e,height:td})}).observe(this.place)}show(t,e){if(this.place.clientWidth===0)return;let n=Tb;t.forEach((c,h)=>{c>0&&(n=Math.max(n,h+1))});const s=Array.from(t.subarray(0,n)),r=s.map((c,h)=>(h+.5)*e),o=s.map(c=>c>0?c:null),a=s.reduce((c,h)=>c+h,0),l=n*e;Sn(this.summary,`${this.name}: ${a} ${k.loop.ticksAxis}, < ${l} ${k.loop.usAxis}`),this.u===null?this.u=new ln(this.options(),[r,o],this.place):this.u.setData([r,o])}options(){const t=()=>cr()?"#c3ccd6":"#43505e",e={stroke:t,font:"11px system-ui, sans-serif",grid:{show:!1},ticks:{size:3,stroke:t,width:1},gap:3};return{width:this.place.clientWidth,height:td,legend:{show:!1},cursor:{show:!1},padding:[6,10,0,0],scales:{x:{time:!1,range:(n,s,r)=>[0,r]},y:{distr:3,range:(n,s,r)=>[Ab,Math.max(10,2*r)]}},axes:[{...e,size:22,splits:(n,s,r,o)=>ml(r,o,6),values:(n,s)=>s.map(r=>`${r} ${k.loop.usAxis}`)},{...e,size:44,splits:(n,s,r,o)=>Array.from({length:Math.floor(Math.log10(o))+1},(a,l)=>10**l),values:(n,s)=>s.map(r=>r===null?"":r<1e4?String(r):r.toExponential(0))}],series:[{},{fill:()=>cr()?"#56b4e9":"#0072b2",width:0,points:{show:!1},paths:ln.paths.bars?.({size:[.9,40]})}]}}}class Rb{constructor(t,e,n){this.store=t,this.view=e,this.plotMs=n,this.counts=tt("dl",{class:"facts"}),this.quantiles=tt("div"),this.guard=tt("dl",{class:"facts"}),this.budget=tt("dl",{class:"facts"}),this.ticks=new ed(k.loop.tick),this.late=new ed(k.loop.late),this.redraw=Fp(500,()=>this.draw()),this.root=Is("loop",k.loop.heading,"engineer",this.counts,tt("h3",{},k.loop.tick),this.ticks.root,tt("h3",{},k.loop.late),this.late.root,this.quantiles,tt("h3",{},k.loop.guard),this.guard,tt("h3",{},k.loop.page),this.budget),t.on(["frame","view"],this.redraw)}draw(){const{frame:t}=this.store;if(t===null||this.store.view!=="engineer")return;t.timing!==null&&this.drawTiming(t.timing);const e=t.needles[this.store.needle];if(e){const s=k.loop.flagNames.filter((l,c)=>(e.flags>>>c&1)===1);e.flags>>>31===1&&s.push(k.loop.kernelFault);const{x:r,y:o,z:a}=e.command;cc(this.guard,[[k.loop.guard,e.guard||k.scores.dash],[k.loop.command,`${[r,o,a].map(l=>l.toFixed(3)).join(", ")} N`],[k.loop.flags,s.join(", ")||k.loop.none],[k.loop.particles,String(t.particles.length)]])}const n=this.view()?.budget;n&&cc(this.budget,[...["message","upload","bodies","draw"].map(s=>[k.loop.parts[s],k.loop.ms(n.median(s))]),[k.loop.parts.plots,k.loop.ms(this.plotMs())]])}drawTiming(t){const e=k.loop.counts,n=r=>t[r].toLocaleString("en");cc(this.counts,Object.keys(e).map(r=>[e[r],n(r)])),this.ticks.show(t.tickBins,t.binUs),this.late.show(t.lateBins,t.binUs);const s=k.loop.quantiles.map((r,o)=>[r,k.units.us(t.tickUs[o]??0),k.units.us(t.lateUs[o]??0)]);this.quantiles.replaceChildren(al([k.loop.quantile,k.loop.tick,k.loop.late],s))}}function cc(i,t){for(;i.children.length>t.length;)i.lastChild?.remove();t.forEach(([e,n],s)=>{i.children[s]||i.append(tt("div",{},tt("dt"),tt("dd")));const[r,o]=i.children[s].children;Sn(r,e),Sn(o,n)})}const Pb=[-1,.1,.25,.5,1,2,4,8],Cb=400;class Lb{constructor(t,e){this.store=t,this.send=e,this.bar=tt("input",{type:"range",min:0,max:0,step:1,value:0,class:"scrub","aria-label":k.playback.position}),this.play=Je(k.playback.play,()=>this.toggle(),{class:"primary"}),this.time=tt("span",{class:"clock"}),this.speed=tt("select"),this.flags=tt("div",{class:"flags","aria-hidden":"true"}),this.playing=!1,this.wanted=null,this.askedAt=-1/0,this.asked=-1,this.rowAsked=-1,this.speed.append(...Pb.map(n=>tt("option",{value:n},k.playback.speedOf(n)))),this.speed.value="1",this.root=tt("section",{class:"playback","aria-label":k.playback.heading,hidden:!0},this.play,Je("|<",()=>this.toEvent(-1),{"aria-label":k.playback.lastEvent}),Je("<",()=>this.seek(this.tick-1),{"aria-label":k.playback.back}),Je(">",()=>this.seek(this.tick+1),{"aria-label":k.playback.forward}),Je(">|",()=>this.toEvent(1),{"aria-label":k.playback.nextEvent}),tt("div",{class:"scrub-place"},this.bar,this.flags),this.time,qo(k.playback.speed,this.speed)),this.bar.addEventListener("input",()=>this.seek(Number(this.bar.value))),this.speed.addEventListener("change",()=>this.playing&&this.sendSpeed()),t.on(["hello"],()=>this.begin()),t.on(["rows"],()=>this.drawFlags()),t.on(["frame"],()=>this.show())}get last(){return this.store.hello?.recordingTicks??0}get tick(){return this.wanted??this.store.frame?.tick??0}toggle(){this.store.playback&&(!this.playing&&this.tick>=this.last&&Number(this.speed.value)>0&&this.seek(0),this.setPlaying(!this.playing),this.sendSpeed())}seek(t){this.store.playback&&(this.wanted=Math.round(Math.min(this.last,Math.max(0,t))),this.playing&&(this.setPlaying(!1),this.sendSpeed()),this.ask())}ask(){this.asked!==this.store.frame?.tick&&performance.now()-this.askedAt<Cb||this.wanted!==null&&(this.asked=this.wanted,this.askedAt=performance.now(),this.send(li.seek(this.wanted)))}setPlaying(t){this.playing=t,Sn(this.play,t?k.playback.hold:k.playback.play)}sendSpeed(){this.send(li.play(this.playing?Number(this.speed.value):0))}toEvent(t){const e=[...this.store.events,...this.store.marks].map(s=>s.tick).sort((s,r)=>s-r),n=t>0?e.find(s=>s>this.tick):e.reverse().find(s=>s<this.tick);this.seek(n??(t>0?this.last:0))}begin(){this.root.hidden=!this.store.playback,this.bar.max=String(this.last),this.wanted=null,this.asked=-1,this.setPlaying(!1),this.drawFlags()}show(){const{frame:t}=this.store;if(t===null||!this.store.playback)return;this.wanted===t.tick?this.wanted=null:this.wanted!==null&&this.ask(),this.wanted===null&&(this.bar.value=String(t.tick)),this.wanted===null&&!this.playing&&this.askExactRow(t.tick),this.playing&&t.tick>=this.last&&Number(this.speed.value)>0&&this.setPlaying(!1);const[e,n]=[t.tick,this.last].map(s=>this.store.seconds(s).toFixed(3));Sn(this.time,k.playback.at(e,n)),this.bar.setAttribute("aria-valuetext",k.playback.at(e,n))}askExactRow(t){t===this.rowAsked||this.store.rows.near(t)?.tick===t||(this.rowAsked=t,this.send(li.rows(t,t,1)))}drawFlags(){if(this.last===0)return;const t=(e,n)=>{const s=tt("span",{class:n});return s.style.left=`${(100*e/this.last).toFixed(3)}%`,s};this.flags.replaceChildren(...this.store.events.map(e=>t(e.tick,"flag")),...this.store.marks.map(e=>t(e.tick,"flag mark")))}}const Ib=.005,Fb=2e-4;var $o=(i=>(i[i.Contact=0]="Contact",i[i.Release=1]="Release",i[i.Puncture=2]="Puncture",i[i.Reentry=3]="Reentry",i[i.Exit=4]="Exit",i[i.Layer=5]="Layer",i[i.Obstacle=6]="Obstacle",i))($o||{});function Db(i,t,e){const[n,s]=[i.find(t),i.find(e+1)-1],[r,o]=[i.column("tick"),i.column("travel")];let a=n,l=n;for(let c=n;c<=s;++c)o[c]>=o[a]&&(a=c);for(let c=a;c<=s&&o[c]>o[a]-Fb;++c)l=c;return s>l&&o[a]-o[s]>Ib?r[l]:null}const Ub=i=>i?.phase==="inserted";function Nb(i,t,e){const n=t.column("tick"),s=n[n.length-1]??0,r=[];let o=null;const a=l=>{o!==null&&r.push({...o,to:l}),o=null};for(const l of i.filter(c=>c.needle===e))if(l.eventKind===0)a(l.tick),o={phase:"contact",from:l.tick,to:s};else if(l.eventKind===2||l.eventKind===3){if(Ub(o))continue;a(l.tick),o={phase:"inserted",from:l.tick,to:s}}else(l.eventKind===1||l.eventKind===4)&&a(l.tick);return a(s),r.flatMap(l=>{const c=l.phase==="inserted"?Db(t,l.from,l.to):null;return c===null?[l]:[{...l,to:c},{phase:"retracting",from:c,to:l.to}]})}const Im=500;function Ya(i,t,e,n,s){return{name:i,colour:yg(t,cr()),dash:t.dash,width:e,xs:n,ys:s}}function Fm(i,t,e,n,s){const r=(l,c=1)=>{const h=i.column(l);return t.map(u=>c*h[u])},o=r(n,e),a=th.map(l=>Ya(k.force.causes[l],cl[l],1.4,o,r(l)));return[Ya(s?k.force.total:k.force.axial,cu,1.8,o,r("force")),...s?a:[Ya(k.force.lateral,hl,1.2,o,r("lateral"))]]}function Ob(i){return k.force.phases[{contact:1,inserted:2,retracting:3}[i]]}function kb(i,t,e){const{rows:n,period:s}=i,r=e===null?0:Math.max(0,n.find(e[0]/s)-1),o=e===null?n.length:Math.min(n.length,n.find(e[1]/s)+1),a=Vp(n.column("force"),r,o,Im),l=i.needle;return{title:k.plots.time,xLabel:k.plots.timeAxis,yLabel:k.plots.forceAxis,curves:Fm(n,a,s,"tick",t),bands:Nb(i.events,n,l).map(({phase:c,from:h,to:u})=>({from:i.seconds(h),to:i.seconds(u),label:Ob(c)})),marks:[...i.events.filter(c=>c.needle===l).map(c=>({x:i.seconds(c.tick),label:Dm(i,c.eventKind,c.layer),strong:!1})),...i.marks.map(c=>({x:i.seconds(c.tick),label:c.text,strong:!0}))]}}function Dm(i,t,e){const n=k.plots.events[t]??String(t),s=t===$o.Layer||t===$o.Puncture,r=i.layerName(e);return s&&r!==""?`${n}: ${r}`:n}function Bb(i,t){const{rows:e}=i,n=Vp(e.column("force"),0,e.length,Im),s=e.column("travel"),r=i.events.filter(o=>o.needle===i.needle).filter(o=>o.eventKind===$o.Puncture||o.eventKind===$o.Layer).flatMap(o=>{const a=e.find(o.tick);return a>=e.length?[]:[{x:1e3*s[a],label:Dm(i,o.eventKind,o.layer),strong:!1}]});return{title:k.plots.depth,xLabel:k.plots.depthAxis,yLabel:k.plots.forceAxis,curves:Fm(e,n,1e3,"travel",t),bands:[],marks:r}}const nd=(i,t)=>Ya(k.scores.attempt(i.attempt),t,1.6,i.rows.map(e=>1e3*e.travel),i.rows.map(e=>e.force));function zb(i,t){return{title:k.compare.plot,xLabel:k.plots.depthAxis,yLabel:k.plots.forceAxis,curves:[nd(i,kp),nd(t,Bp)],bands:[],marks:[]}}function Vb(i,t){const e=i.rows.map(n=>n.tick*t);return{title:k.scores.attempt(i.attempt),xLabel:k.plots.timeAxis,yLabel:k.plots.forceAxis,curves:[{name:k.force.axial,colour:cu.colour,dash:[],width:1.6,xs:e,ys:i.rows.map(n=>n.force)},{name:k.force.lateral,colour:hl.colour,dash:hl.dash,width:1.2,xs:e,ys:i.rows.map(n=>n.lateral)}],bands:[],marks:i.punctures.map(n=>({x:n.tick*t,label:n.layer,strong:!1}))}}const pa=()=>cr()?"#c3ccd6":"#43505e",id=()=>cr()?"#2b343e":"#e2e7ed",Hb=i=>(cr()?["#1c232b","#222a33"]:["#f4f6f9","#eaeef3"])[i%2];function Gb(i,t){const e=new Path2D;return ln.orient(i,t,(n,s,r,o,a,l,c,h,u,f,p)=>{const[_,b]=[s,r];for(let m=0;m<_.length;++m)e.lineTo(l(_[m],o,f,h),c(b[m],a,p,u));return null}),{stroke:e}}class ph{constructor(t){this.options=t,this.place=tt("div",{class:"plot-place"}),this.legend=tt("ul",{class:"legend","aria-label":k.plots.legend}),this.summary=tt("p",{class:"quiet-text"}),this.u=null,this.figure=null,this.shape="",this.cursor=null,this.range=null;const{png:e,svg:n,csv:s}=k.plots,r=tt("div",{class:"plot-tools"},Je(e,()=>this.savePng(),{"aria-label":k.plots.exportLabel(e)}),Je(n,()=>this.saveSvg(),{"aria-label":k.plots.exportLabel(n)}),Je(s,()=>this.saveCsv(),{"aria-label":k.plots.exportLabel(s)}));this.root=tt("div",{class:"plot"},this.place,tt("div",{class:"plot-foot"},this.legend,r),this.summary),this.listen(),new ResizeObserver(()=>this.fit()).observe(this.place),matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>{this.shape="",this.figure!==null&&this.show(this.figure)})}get visible(){return this.place.offsetParent!==null}show(t){if(this.figure=t,!this.visible)return;const e=t.curves.map(o=>o.name+o.colour).join()+t.xLabel,n=[null,...t.curves.map(o=>[o.xs,o.ys])];this.u===null||e!==this.shape?(this.shape=e,this.u?.destroy(),this.u=new ln(this.uplotOptions(t),n,this.place),this.drawLegend(t.curves)):this.u.setData(n);const s=Math.max(0,...t.curves.slice(0,1).map(o=>Wb(o.ys))),r=k.plots.description(t.title,t.curves[0]?.xs.length??0,s);Sn(this.summary,this.options.step?`${r} ${k.plots.keyboard}`:r)}setCursor(t){this.cursor!==t&&(this.cursor=t,this.visible&&this.u?.redraw(!1))}setRange(t){this.range=t,this.figure!==null&&this.show(this.figure)}uplotOptions(t){const e=(s,r)=>({label:s,labelSize:18,size:r,font:"11px system-ui, sans-serif",labelFont:"12px system-ui, sans-serif",stroke:pa,grid:{stroke:id,width:1},ticks:{stroke:id,width:1,size:4},gap:3,splits:(o,a,l,c)=>ml(l,c,s===t.xLabel?6:5),values:(o,a)=>a.map(String)}),n=s=>({label:s.name,stroke:s.colour,width:s.width,dash:s.dash,paths:Gb,facets:[{scale:"x",auto:!0},{scale:"y",auto:!0}]});return{mode:2,width:Math.max(120,this.place.clientWidth),height:this.options.height,legend:{show:!1},padding:[8,10,0,0],cursor:{show:!1},scales:{x:{time:!1,range:()=>this.range??dh(this.now())},y:{range:()=>Pm(this.now().curves.map(s=>s.ys))}},axes:[e(t.xLabel,30),e(t.yLabel,38)],series:[{},...t.curves.map(n)],hooks:{drawClear:[s=>this.drawBands(s)],draw:[s=>this.drawMarks(s)]}}}now(){return this.figure??{title:"",xLabel:"",yLabel:"",curves:[],bands:[],marks:[]}}drawBands(t){const{ctx:e,bbox:n}=t,s=devicePixelRatio;e.save(),e.beginPath(),e.rect(n.left,n.top,n.width,n.height),e.clip(),e.font=`${10.5*s}px system-ui, sans-serif`,e.textAlign="center",this.now().bands.forEach((r,o)=>{const[a,l]=[t.valToPos(r.from,"x",!0),t.valToPos(r.to,"x",!0)];e.fillStyle=Hb(o),e.fillRect(a,n.top,l-a,n.height);const c=(Math.max(a,n.left)+Math.min(l,n.left+n.width))/2;l-a<e.measureText(r.label).width+8*s||(e.fillStyle=pa(),e.fillText(r.label,c,n.top+n.height-5*s))}),e.restore()}drawMarks(t){const{ctx:e,bbox:n}=t,s=devicePixelRatio,r=(a,l,c,h)=>{e.strokeStyle=l,e.lineWidth=h*s,e.setLineDash(c.map(u=>u*s)),e.beginPath(),e.moveTo(a,n.top),e.lineTo(a,n.top+n.height),e.stroke()};e.save(),e.beginPath(),e.rect(n.left,n.top,n.width,n.height),e.clip(),e.font=`${10.5*s}px system-ui, sans-serif`,e.textAlign="left";let o=[-1/0,-1/0];for(const a of this.now().marks){const l=t.valToPos(a.x,"x",!0);r(l,pa(),a.strong?[]:[2,3],1);const c=o.findIndex(h=>h<l);c<0||(e.fillStyle=pa(),e.fillText(a.label,l+3*s,n.top+(11+13*c)*s),o=o.map((h,u)=>u===c?l+e.measureText(a.label).width+8*s:h))}this.cursor!==null&&r(t.valToPos(this.cursor,"x",!0),cr()?"#ffffff":"#101820",[],1.5),e.restore()}drawLegend(t){this.legend.replaceChildren(...t.map(e=>{const n=document.createElementNS("http://www.w3.org/2000/svg","svg"),s=document.createElementNS("http://www.w3.org/2000/svg","line"),r=(o,a)=>Object.entries(a).forEach(([l,c])=>o.setAttribute(l,c));return r(n,{viewBox:"0 0 24 8",class:"swatch","aria-hidden":"true"}),r(s,{x1:"0",x2:"24",y1:"4",y2:"4",stroke:e.colour}),r(s,{"stroke-width":String(e.width),"stroke-dasharray":e.dash.join(" ")}),n.append(s),tt("li",{},n,e.name)}))}fit(){const t=this.place.clientWidth;t!==0&&(this.u===null||this.shape===""?this.figure!==null&&this.show(this.figure):Math.abs(this.u.width-t)>1&&this.u.setSize({width:t,height:this.options.height}))}xAt(t){return this.u===null?null:this.u.posToVal(t.clientX-this.u.over.getBoundingClientRect().left,"x")}listen(){const{seek:t,step:e,zoom:n}=this.options;if(e!==void 0&&(this.place.tabIndex=0,this.place.setAttribute("role","group"),this.place.addEventListener("keydown",s=>{const r={ArrowLeft:-1,ArrowRight:1,PageDown:-50,PageUp:50}[s.key];r!==void 0&&(s.preventDefault(),e(r))})),t!==void 0){const s=(r,o)=>{const a=this.xAt(r);a!==null&&t(a,o)};this.place.addEventListener("pointerdown",r=>{this.place.setPointerCapture(r.pointerId),s(r,!0)}),this.place.addEventListener("pointermove",r=>r.buttons===1&&s(r,!1)),this.place.addEventListener("pointerup",r=>s(r,!0))}n!==void 0&&(this.place.addEventListener("dblclick",()=>n(null)),this.place.addEventListener("wheel",s=>{const r=this.xAt(s);if(r===null||!s.ctrlKey)return;s.preventDefault();const[o,a]=this.range??dh(this.now()),l=s.deltaY<0?.7:1.4;n([r-(r-o)*l,r+(a-r)*l])},{passive:!1}))}savePng(){this.figure!==null&&Lm(this.printed()).toBlob(t=>{t!==null&&ec(`${this.options.name}.png`,"image/png",t)})}saveSvg(){this.figure!==null&&ec(`${this.options.name}.svg`,"image/svg+xml",wb(this.printed()))}saveCsv(){const{head:t,columns:e}=this.options.numbers();ec(`${this.options.name}.csv`,"text/csv",Eb(t,e,Wr))}printed(){const t=this.now();return{...t,curves:t.curves.map(e=>({...e,colour:wg(e.colour)}))}}}const Wb=i=>i.reduce((t,e)=>Math.max(t,Math.abs(e)),0),Xb=150,Yb=20,qb=2e3;class jb{constructor(t,e,n){this.store=t,this.send=e,this.drawMs=0,this.byCause=!1,this.recent=!1,this.zoomed=null,this.redraw=Fp(Xb,()=>this.draw());const s=()=>({head:["tick","time_s",...Zb],columns:[t.rows.column("tick"),t.rows.column("tick").map(r=>Number((r*t.period).toPrecision(9))),...$r.slice(1).map(r=>t.rows.column(r))]});this.time=new ph({name:"force-time",height:176,numbers:s,seek:r=>t.playback&&n(r/t.period),step:r=>t.playback&&n((t.frame?.tick??0)+20*r),zoom:r=>this.zoom(r)}),this.depth=new ph({name:"force-depth",height:176,numbers:s}),this.causeSwitch=nh(k.plots.byCause,r=>{this.byCause=r,this.redraw()}),this.windowSwitch=nh(k.plots.window,r=>{this.recent=r,this.redraw()}),this.root=Is("plots",k.plots.time,"teacher engineer",tt("div",{class:"panel-tools"},this.causeSwitch,this.windowSwitch),this.time.root,tt("h2",{},k.plots.depth),this.depth.root),t.on(["rows","needle","organ"],this.redraw),t.on(["frame"],()=>this.follow()),t.on(["hello"],()=>this.begin()),t.on(["view"],()=>{au(this.causeSwitch,t.view==="engineer",r=>this.byCause=r),this.redraw()})}begin(){this.zoomed=null,this.windowSwitch.hidden=this.store.playback,this.store.playback&&this.askRows(0,this.store.hello?.recordingTicks??0),this.redraw()}askRows(t,e){this.send(li.rows(Math.max(0,Math.floor(t)),Math.ceil(e),qb))}zoom(t){const e=this.store.seconds(this.store.hello?.recordingTicks??0);if(this.zoomed=t,t!==null&&this.store.playback){const[n,s]=[Math.max(0,t[0]),Math.min(e,t[1])];this.zoomed=[n,s],this.askRows(n/this.store.period,s/this.store.period)}this.redraw()}follow(){const{frame:t,playback:e}=this.store;if(!e||t===null)return;this.time.setCursor(this.store.seconds(t.tick));const n=this.store.rows.near(t.tick);this.depth.setCursor(n===null?null:1e3*n.travel)}range(){if(this.zoomed!==null)return this.zoomed;const t=this.store.rows.column("tick"),e=this.store.seconds(t[t.length-1]??0);return this.recent&&!this.store.playback?[Math.max(0,e-Yb),e]:null}draw(){const t=performance.now(),e=this.range(),n=(s,r)=>s.visible&&s.show(r());this.time.setRange(e),n(this.time,()=>kb(this.store,this.byCause,e)),n(this.depth,()=>Bb(this.store,this.byCause)),this.follow(),this.drawMs=performance.now()-t}}const $b={depth:"depth_m",travel:"travel_m",tickUs:"tick_us",lateUs:"late_us"},Zb=$r.slice(1).map(i=>$b[i]??`${i}_n`),Kb=25e-5,Jb=.15,Qb=.02,tv=90,sd=.2,rd=.3,od={KeyW:["z",-1],KeyS:["z",1],KeyA:["x",-1],KeyD:["x",1],KeyR:["y",1],KeyF:["y",-1],KeyQ:["roll",1],KeyE:["roll",-1]};function ev(i){const t=i*Math.PI/360;return{w:Math.cos(t),x:0,y:0,z:Math.sin(t)}}const hc=i=>Math.min(rd,Math.max(-rd,i));class nv{constructor(t,e){this.store=t,this.send=e,this.pad=tt("div",{class:"pad",tabindex:0,role:"application","aria-label":k.pointer.pad}),this.stem=tt("div",{class:"stem","aria-hidden":"true"}),this.pull=tt("div",{class:"pull","aria-hidden":"true"}),this.words=tt("p",{class:"pad-words"}),this.place={x:0,y:0,z:0},this.roll=0,this.activity=Kn.Ready,this.held=!1,this.pressed=new Set,this.slow=!1,this.stale=!1,this.last=0,this.pad.append(this.pull,this.stem,this.words),this.root=Is("pointer",k.pointer.heading,"trainee engineer",this.pad,tt("p",{class:"quiet-text"},k.pointer.help),Je(k.pointer.home,()=>this.home())),this.root.hidden=!0,this.listen(),t.on(["hello"],()=>this.begin()),t.on(["frame"],()=>{this.homeWhenReset(),this.showForce()}),requestAnimationFrame(n=>this.step(n))}get needle(){return(this.store.hello?.needles??[]).findIndex(e=>e.device.startsWith("pointer:"))}begin(){this.root.hidden=this.needle<0||this.store.playback||!this.store.hello?.mayControl,this.home()}homeWhenReset(){const t=this.store.frame?.activity??Kn.Ready;t===Kn.Ready&&this.activity!==Kn.Ready&&this.home(),this.activity=t}home(){this.place={x:0,y:0,z:0},this.roll=0,this.changed()}changed(){this.stale=!0,Sn(this.words,`${k.pointer.advance(-1e3*this.place.z)}
${k.pointer.roll(this.roll)}`);const{x:t,z:e}=this.place,[n,s]=[t,-e].map(r=>Math.max(-60,Math.min(60,600*r)));this.stem.style.transform=`translate(${n}px, ${-s}px) rotate(${this.roll}deg)`}drag(t){if(!this.held)return;const e=Kb*(t.shiftKey?sd:1);this.place.x=hc(this.place.x+e*t.movementX),this.place.z=hc(this.place.z+e*t.movementY),this.changed()}listen(){const{pad:t}=this;t.addEventListener("pointerdown",e=>{this.held=!0,t.setPointerCapture(e.pointerId),t.classList.add("held"),this.stale=!0});for(const e of["pointerup","pointercancel"])t.addEventListener(e,()=>{this.held=!1,t.classList.remove("held"),this.stale=!0});t.addEventListener("pointermove",e=>this.drag(e)),t.addEventListener("wheel",e=>{e.preventDefault(),this.roll+=Jb*e.deltaY,this.changed()},{passive:!1}),t.addEventListener("keydown",e=>{this.slow=e.shiftKey,!(!(e.code in od)||e.ctrlKey||e.altKey||e.metaKey)&&(e.preventDefault(),e.stopPropagation(),this.pressed.add(e.code))}),t.addEventListener("keyup",e=>{this.slow=e.shiftKey,this.pressed.delete(e.code)}),t.addEventListener("blur",()=>this.pressed.clear())}step(t){requestAnimationFrame(r=>this.step(r));const e=Math.min(.1,(t-this.last)/1e3);this.last=t;const n=e*(this.slow?sd:1);for(const r of this.pressed){const[o,a]=od[r];o==="roll"?this.roll+=a*n*tv:this.place[o]=hc(this.place[o]+a*n*Qb),this.changed()}if(!this.stale||this.root.hidden)return;this.stale=!1;const s=this.held||this.pressed.size>0?1:0;this.send(li.pointer(this.needle,this.place,ev(this.roll),s))}showForce(){const t=this.store.frame?.needles[this.needle],e=this.store.hello?.needles[this.needle];if(!t||!e||this.root.hidden)return;const{x:n,y:s,z:r}=t.force,o=Math.min(1,Math.hypot(n,s,r)/(e.maxForce||10));this.pull.style.transform=`scaleY(${o.toFixed(3)})`}}const iv=120;class sv{constructor(t,e,n){this.store=t,this.seek=n,this.input=tt("input",{type:"text",maxlength:iv,placeholder:k.marks.hint}),this.list=tt("ol",{class:"marks-list"});const s=tt("form",{class:"row"},qo(k.marks.label,this.input),tt("button",{type:"submit"},k.marks.add));s.addEventListener("submit",r=>{r.preventDefault();const o=this.input.value.trim();o!==""&&(e(li.mark(o)),this.input.value="")}),this.root=Is("marks",k.marks.heading,"teacher",s,this.list),t.on(["rows","hello"],()=>this.show()),this.show()}show(){const{marks:t}=this.store;if(Number(this.list.dataset.count??-1)===t.length&&t.length>0)return;this.list.dataset.count=String(t.length);const n=t.map(s=>{const r=k.marks.goTo(this.store.seconds(s.tick).toFixed(2),s.text),o=this.store.playback?Je(r,()=>this.seek(s.tick),{class:"link"}):r;return tt("li",{},o)});this.list.replaceChildren(...n.length>0?n:[tt("li",{class:"empty"},k.marks.none)])}}function bl(i){const t=k.scores.lines,{n:e,mm:n,s}=k.units,r=i.targets.filter(h=>!h.forbidden),o=i.targets.filter(h=>h.forbidden),a=r.filter(h=>h.reached).length,l=o.filter(h=>h.reached).length,c=r.length>0?Math.min(...r.map(h=>h.closest)):null;return[[t.duration,s(i.duration),i.duration],[t.path,n(i.path),i.path],[t.depthPath,n(i.depthPath),i.depthPath],[t.punctures,String(i.punctures.length),i.punctures.length],[t.withdrawals,String(i.withdrawals),i.withdrawals],[t.targets,k.scores.of(a,r.length),a],[t.forbidden,k.scores.of(l,o.length),l],[t.closest,c===null?k.scores.dash:n(c),c],[t.peakForce,e(i.peakForce),i.peakForce],[t.peakLateral,e(i.peakLateral),i.peakLateral],[t.meanForce,e(i.meanForce),i.meanForce],[t.faults,String(i.faults),i.faults]]}const Zo=i=>i.trainee===""?k.scores.attempt(i.attempt):`${k.scores.attempt(i.attempt)}, ${i.trainee}`;class rv{constructor(t){this.store=t,this.content=tt("div"),this.root=Is("score",k.scores.heading,"trainee teacher",this.content),t.on(["scores"],()=>this.show()),this.show()}show(){const t=this.store.scores[this.store.scores.length-1];if(t===void 0){this.content.replaceChildren(tt("p",{class:"empty"},k.scores.none));return}const e=tt("dl",{class:"facts"});for(const[s,r]of bl(t))e.append(tt("div",{},tt("dt",{},s),tt("dd",{},r)));const n=t.punctures.map(s=>tt("li",{},k.scores.puncture(s.layer,k.units.n(s.force))));this.content.replaceChildren(tt("p",{class:"attempt"},Zo(t)),e,...n.length>0?[tt("h3",{},k.scores.lines.punctures),tt("ul",{class:"plain"},...n)]:[])}}class ov{constructor(t){this.store=t,this.choices=[tt("select"),tt("select")],this.content=tt("div"),this.hint=tt("p",{class:"empty"},k.compare.need),this.plot=new ph({name:"comparison",height:190,numbers:()=>this.numbers()}),this.body=tt("div",{hidden:!0},tt("div",{class:"row"},qo(k.compare.first,this.choices[0]),qo(k.compare.second,this.choices[1])),this.plot.root,this.content),this.root=Is("compare",k.compare.heading,"teacher",this.hint,this.body);for(const e of this.choices)e.addEventListener("change",()=>this.show());t.on(["scores"],()=>this.refill()),t.on(["view"],()=>this.show())}refill(){const{scores:t}=this.store,e=t.length>=2;this.hint.hidden=e,this.body.hidden=!e,this.choices.forEach((n,s)=>{n.replaceChildren(...t.map(o=>tt("option",{value:o.attempt},Zo(o))));const r=t[t.length-2+s];r&&(n.value=String(r.attempt))}),this.show()}chosen(){const[t,e]=this.choices.map(n=>this.store.scores.find(s=>String(s.attempt)===n.value));return t&&e?[t,e]:null}show(){const t=this.chosen();if(t===null||this.body.hidden)return;this.plot.show(zb(...t));const[e,n]=t.map(bl),s=e.map(([o,a,l],c)=>[o,a,n[c][1],av(l,n[c][2])]),r=[k.compare.what,...t.map(Zo),k.compare.difference];this.content.replaceChildren(al(r,s))}numbers(){const t=this.chosen()??[];return{head:["attempt","tick","travel_m","force_n","lateral_n"],columns:[t.flatMap(e=>e.rows.map(()=>e.attempt)),...["tick","travel","force","lateral"].map(e=>t.flatMap(n=>n.rows.map(s=>s[e])))]}}}function av(i,t){if(i===null||t===null||i===t)return k.scores.dash;if(i===0)return"";const e=(t-i)/Math.abs(i);return`${e>0?"+":""}${k.units.percent(e)}`}class lv{constructor(t){this.store=t,this.content=tt("div",{class:"paper"}),this.root=Is("report",k.report.heading,"report",tt("div",{class:"panel-tools"},Je(k.report.print,()=>window.print(),{class:"primary"})),this.content),t.on(["view","scores","hello"],()=>this.show()),window.addEventListener("beforeprint",()=>this.draw())}show(){this.store.view==="report"&&this.draw()}draw(){const{hello:t,scores:e,marks:n}=this.store,s=new Date().toLocaleString("en-GB",{dateStyle:"long",timeStyle:"short"}),r=[t?.scene??"",k.report.made(s),k.report.version(t?.version??"")];this.content.replaceChildren(tt("p",{class:"report-head"},r.join(" · ")),...e.length>0?this.attempts(e):[tt("p",{class:"empty"},k.report.none)],...n.length>0?[tt("h3",{},k.report.marks),tt("ol",{},...n.map(o=>tt("li",{},k.marks.goTo(this.store.seconds(o.tick).toFixed(2),o.text))))]:[],tt("p",{class:"signature"},k.report.signature))}attempts(t){const e=bl(t[0]).map(([o])=>o),n=t.map(o=>bl(o).map(([,a])=>a)),s=[[k.scores.lines.trainee,...t.map(o=>o.trainee||k.scores.dash)],[k.scores.lines.began,...t.map(o=>o.began.replace("T"," "))],...e.map((o,a)=>[o,...n.map(l=>l[a])]),[k.scores.lines.recording,...t.map(o=>o.recording||k.scores.notKept)]],r=["",...t.map(o=>k.scores.attempt(o.attempt))];return[tt("h3",{},k.report.attempts),tt("div",{class:"wide"},al(r,s)),tt("h3",{},k.report.curves),...t.filter(o=>o.rows.length>1).map(o=>this.curve(o)),...t.filter(o=>o.targets.length>0).map(o=>this.targets(o))]}curve(t){const e=Lm(Vb(t,this.store.period));return e.setAttribute("role","img"),e.setAttribute("aria-label",`${k.report.curves}: ${Zo(t)}`),tt("figure",{},e)}targets(t){const{kinds:e,yes:n,no:s}=k.report,r=t.targets.map(a=>[a.name,a.forbidden?e.forbidden:e.target,k.units.mm(a.closest),a.reached?n:s]),o=[k.report.target,k.report.kind,k.report.closest,k.report.reached];return tt("div",{class:"wide"},al(o,r,`${k.report.targets}: ${Zo(t)}`))}}/**
 * @license
 * Copyright 2010-2024 Three.js Authors
 * SPDX-License-Identifier: MIT
 */const wu="170",Qr={ROTATE:0,DOLLY:1,PAN:2},Zr={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},cv=0,ad=1,hv=2,Um=1,uv=2,$i=3,as=0,Gn=1,ki=2,rs=0,to=1,ld=2,cd=3,hd=4,fv=5,ir=100,dv=101,pv=102,mv=103,_v=104,gv=200,bv=201,vv=202,xv=203,mh=204,_h=205,Mv=206,Sv=207,yv=208,wv=209,Ev=210,Tv=211,Av=212,Rv=213,Pv=214,gh=0,bh=1,vh=2,co=3,xh=4,Mh=5,Sh=6,yh=7,Dl=0,Cv=1,Lv=2,As=0,Iv=1,Fv=2,Dv=3,Uv=4,Nv=5,Ov=6,kv=7,Nm=300,ho=301,uo=302,wh=303,Eh=304,Ul=306,Th=1e3,rr=1001,Ah=1002,Cn=1003,Bv=1004,ma=1005,Bi=1006,uc=1007,or=1008,ls=1009,Om=1010,Eu=1011,Ko=1012,Nl=1013,ur=1014,yi=1015,ta=1016,Tu=1017,Au=1018,fo=1020,km=35902,Bm=1021,zm=1022,wi=1023,Vm=1024,Hm=1025,eo=1026,po=1027,Ru=1028,Pu=1029,Gm=1030,Cu=1031,Ol=1033,qa=33776,ja=33777,$a=33778,Za=33779,Rh=35840,Ph=35841,Ch=35842,Lh=35843,Ih=36196,Fh=37492,Dh=37496,Uh=37808,Nh=37809,Oh=37810,kh=37811,Bh=37812,zh=37813,Vh=37814,Hh=37815,Gh=37816,Wh=37817,Xh=37818,Yh=37819,qh=37820,jh=37821,Ka=36492,$h=36494,Zh=36495,Wm=36283,Kh=36284,Jh=36285,Qh=36286,zv=3200,Vv=3201,Lu=0,Hv=1,Es="",ai="srgb",pr="srgb-linear",kl="linear",Te="srgb",Pr=7680,ud=519,Gv=512,Wv=513,Xv=514,Xm=515,Yv=516,qv=517,jv=518,$v=519,fd=35044,Jo="300 es",ns=2e3,vl=2001;class mr{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});const n=this._listeners;n[t]===void 0&&(n[t]=[]),n[t].indexOf(e)===-1&&n[t].push(e)}hasEventListener(t,e){if(this._listeners===void 0)return!1;const n=this._listeners;return n[t]!==void 0&&n[t].indexOf(e)!==-1}removeEventListener(t,e){if(this._listeners===void 0)return;const s=this._listeners[t];if(s!==void 0){const r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){if(this._listeners===void 0)return;const n=this._listeners[t.type];if(n!==void 0){t.target=this;const s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,t);t.target=null}}}const En=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],Ja=Math.PI/180,tu=180/Math.PI;function ea(){const i=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(En[i&255]+En[i>>8&255]+En[i>>16&255]+En[i>>24&255]+"-"+En[t&255]+En[t>>8&255]+"-"+En[t>>16&15|64]+En[t>>24&255]+"-"+En[e&63|128]+En[e>>8&255]+"-"+En[e>>16&255]+En[e>>24&255]+En[n&255]+En[n>>8&255]+En[n>>16&255]+En[n>>24&255]).toLowerCase()}function Rn(i,t,e){return Math.max(t,Math.min(e,i))}function Zv(i,t){return(i%t+t)%t}function fc(i,t,e){return(1-e)*i+e*t}function Co(i,t){switch(t.constructor){case Float32Array:return i;case Uint32Array:return i/4294967295;case Uint16Array:return i/65535;case Uint8Array:return i/255;case Int32Array:return Math.max(i/2147483647,-1);case Int16Array:return Math.max(i/32767,-1);case Int8Array:return Math.max(i/127,-1);default:throw new Error("Invalid component type.")}}function Vn(i,t){switch(t.constructor){case Float32Array:return i;case Uint32Array:return Math.round(i*4294967295);case Uint16Array:return Math.round(i*65535);case Uint8Array:return Math.round(i*255);case Int32Array:return Math.round(i*2147483647);case Int16Array:return Math.round(i*32767);case Int8Array:return Math.round(i*127);default:throw new Error("Invalid component type.")}}const Kv={DEG2RAD:Ja};class qt{constructor(t=0,e=0){qt.prototype.isVector2=!0,this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){const e=this.x,n=this.y,s=t.elements;return this.x=s[0]*e+s[3]*n+s[6],this.y=s[1]*e+s[4]*n+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this}clampLength(t,e){const n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){const e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;const n=this.dot(t)/e;return Math.acos(Rn(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){const e=this.x-t.x,n=this.y-t.y;return e*e+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){const n=Math.cos(e),s=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*n-o*s+t.x,this.y=r*s+o*n+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}}class te{constructor(t,e,n,s,r,o,a,l,c){te.prototype.isMatrix3=!0,this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c)}set(t,e,n,s,r,o,a,l,c){const h=this.elements;return h[0]=t,h[1]=s,h[2]=a,h[3]=e,h[4]=r,h[5]=l,h[6]=n,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){const e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],this}extractBasis(t,e,n){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(t){const e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){const n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],h=n[4],u=n[7],f=n[2],p=n[5],_=n[8],b=s[0],m=s[3],d=s[6],S=s[1],E=s[4],v=s[7],U=s[2],P=s[5],I=s[8];return r[0]=o*b+a*S+l*U,r[3]=o*m+a*E+l*P,r[6]=o*d+a*v+l*I,r[1]=c*b+h*S+u*U,r[4]=c*m+h*E+u*P,r[7]=c*d+h*v+u*I,r[2]=f*b+p*S+_*U,r[5]=f*m+p*E+_*P,r[8]=f*d+p*v+_*I,this}multiplyScalar(t){const e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){const t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8];return e*o*h-e*a*c-n*r*h+n*a*l+s*r*c-s*o*l}invert(){const t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=h*o-a*c,f=a*l-h*r,p=c*r-o*l,_=e*u+n*f+s*p;if(_===0)return this.set(0,0,0,0,0,0,0,0,0);const b=1/_;return t[0]=u*b,t[1]=(s*c-h*n)*b,t[2]=(a*n-s*o)*b,t[3]=f*b,t[4]=(h*e-s*l)*b,t[5]=(s*r-a*e)*b,t[6]=p*b,t[7]=(n*l-c*e)*b,t[8]=(o*e-n*r)*b,this}transpose(){let t;const e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){const e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,n,s,r,o,a){const l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+t,-s*c,s*l,-s*(-c*o+l*a)+a+e,0,0,1),this}scale(t,e){return this.premultiply(dc.makeScale(t,e)),this}rotate(t){return this.premultiply(dc.makeRotation(-t)),this}translate(t,e){return this.premultiply(dc.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){const e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,n,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){const e=this.elements,n=t.elements;for(let s=0;s<9;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<9;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){const n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t}clone(){return new this.constructor().fromArray(this.elements)}}const dc=new te;function Ym(i){for(let t=i.length-1;t>=0;--t)if(i[t]>=65535)return!0;return!1}function xl(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function Jv(){const i=xl("canvas");return i.style.display="block",i}const dd={};function Ho(i){i in dd||(dd[i]=!0,console.warn(i))}function Qv(i,t,e){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(t,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:n()}}setTimeout(r,e)})}function tx(i){const t=i.elements;t[2]=.5*t[2]+.5*t[3],t[6]=.5*t[6]+.5*t[7],t[10]=.5*t[10]+.5*t[11],t[14]=.5*t[14]+.5*t[15]}function ex(i){const t=i.elements;t[11]===-1?(t[10]=-t[10]-1,t[14]=-t[14]):(t[10]=-t[10],t[14]=-t[14]+1)}const ue={enabled:!0,workingColorSpace:pr,spaces:{},convert:function(i,t,e){return this.enabled===!1||t===e||!t||!e||(this.spaces[t].transfer===Te&&(i.r=os(i.r),i.g=os(i.g),i.b=os(i.b)),this.spaces[t].primaries!==this.spaces[e].primaries&&(i.applyMatrix3(this.spaces[t].toXYZ),i.applyMatrix3(this.spaces[e].fromXYZ)),this.spaces[e].transfer===Te&&(i.r=no(i.r),i.g=no(i.g),i.b=no(i.b))),i},fromWorkingColorSpace:function(i,t){return this.convert(i,this.workingColorSpace,t)},toWorkingColorSpace:function(i,t){return this.convert(i,t,this.workingColorSpace)},getPrimaries:function(i){return this.spaces[i].primaries},getTransfer:function(i){return i===Es?kl:this.spaces[i].transfer},getLuminanceCoefficients:function(i,t=this.workingColorSpace){return i.fromArray(this.spaces[t].luminanceCoefficients)},define:function(i){Object.assign(this.spaces,i)},_getMatrix:function(i,t,e){return i.copy(this.spaces[t].toXYZ).multiply(this.spaces[e].fromXYZ)},_getDrawingBufferColorSpace:function(i){return this.spaces[i].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(i=this.workingColorSpace){return this.spaces[i].workingColorSpaceConfig.unpackColorSpace}};function os(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function no(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}const pd=[.64,.33,.3,.6,.15,.06],md=[.2126,.7152,.0722],_d=[.3127,.329],gd=new te().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),bd=new te().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);ue.define({[pr]:{primaries:pd,whitePoint:_d,transfer:kl,toXYZ:gd,fromXYZ:bd,luminanceCoefficients:md,workingColorSpaceConfig:{unpackColorSpace:ai},outputColorSpaceConfig:{drawingBufferColorSpace:ai}},[ai]:{primaries:pd,whitePoint:_d,transfer:Te,toXYZ:gd,fromXYZ:bd,luminanceCoefficients:md,outputColorSpaceConfig:{drawingBufferColorSpace:ai}}});let Cr;class nx{static getDataURL(t){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let e;if(t instanceof HTMLCanvasElement)e=t;else{Cr===void 0&&(Cr=xl("canvas")),Cr.width=t.width,Cr.height=t.height;const n=Cr.getContext("2d");t instanceof ImageData?n.putImageData(t,0,0):n.drawImage(t,0,0,t.width,t.height),e=Cr}return e.width>2048||e.height>2048?(console.warn("THREE.ImageUtils.getDataURL: Image converted to jpg for performance reasons",t),e.toDataURL("image/jpeg",.6)):e.toDataURL("image/png")}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){const e=xl("canvas");e.width=t.width,e.height=t.height;const n=e.getContext("2d");n.drawImage(t,0,0,t.width,t.height);const s=n.getImageData(0,0,t.width,t.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=os(r[o]/255)*255;return n.putImageData(s,0,0),e}else if(t.data){const e=t.data.slice(0);for(let n=0;n<e.length;n++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[n]=Math.floor(os(e[n]/255)*255):e[n]=os(e[n]);return{data:e,width:t.width,height:t.height}}else return console.warn("THREE.ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}}let ix=0;class qm{constructor(t=null){this.isSource=!0,Object.defineProperty(this,"id",{value:ix++}),this.uuid=ea(),this.data=t,this.dataReady=!0,this.version=0}set needsUpdate(t){t===!0&&this.version++}toJSON(t){const e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];const n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(pc(s[o].image)):r.push(pc(s[o]))}else r=pc(s);n.url=r}return e||(t.images[this.uuid]=n),n}}function pc(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?nx.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(console.warn("THREE.Texture: Unable to serialize Texture."),{})}let sx=0;class kn extends mr{constructor(t=kn.DEFAULT_IMAGE,e=kn.DEFAULT_MAPPING,n=rr,s=rr,r=Bi,o=or,a=wi,l=ls,c=kn.DEFAULT_ANISOTROPY,h=Es){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:sx++}),this.uuid=ea(),this.name="",this.source=new qm(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new qt(0,0),this.repeat=new qt(1,1),this.center=new qt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new te,this.generateMipmaps=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.version=0,this.onUpdate=null,this.isRenderTargetTexture=!1,this.pmremVersion=0}get image(){return this.source.data}set image(t=null){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}toJSON(t){const e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];const n={metadata:{version:4.6,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),e||(t.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==Nm)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case Th:t.x=t.x-Math.floor(t.x);break;case rr:t.x=t.x<0?0:1;break;case Ah:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case Th:t.y=t.y-Math.floor(t.y);break;case rr:t.y=t.y<0?0:1;break;case Ah:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}}kn.DEFAULT_IMAGE=null;kn.DEFAULT_MAPPING=Nm;kn.DEFAULT_ANISOTROPY=1;class ze{constructor(t=0,e=0,n=0,s=1){ze.prototype.isVector4=!0,this.x=t,this.y=e,this.z=n,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,n,s){return this.x=t,this.y=e,this.z=n,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){const e=this.x,n=this.y,s=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*e+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*e+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*e+o[7]*n+o[11]*s+o[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);const e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,n,s,r;const l=t.elements,c=l[0],h=l[4],u=l[8],f=l[1],p=l[5],_=l[9],b=l[2],m=l[6],d=l[10];if(Math.abs(h-f)<.01&&Math.abs(u-b)<.01&&Math.abs(_-m)<.01){if(Math.abs(h+f)<.1&&Math.abs(u+b)<.1&&Math.abs(_+m)<.1&&Math.abs(c+p+d-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;const E=(c+1)/2,v=(p+1)/2,U=(d+1)/2,P=(h+f)/4,I=(u+b)/4,F=(_+m)/4;return E>v&&E>U?E<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(E),s=P/n,r=I/n):v>U?v<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(v),n=P/s,r=F/s):U<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(U),n=I/r,s=F/r),this.set(n,s,r,e),this}let S=Math.sqrt((m-_)*(m-_)+(u-b)*(u-b)+(f-h)*(f-h));return Math.abs(S)<.001&&(S=1),this.x=(m-_)/S,this.y=(u-b)/S,this.z=(f-h)/S,this.w=Math.acos((c+p+d-1)/2),this}setFromMatrixPosition(t){const e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this.z=Math.max(t.z,Math.min(e.z,this.z)),this.w=Math.max(t.w,Math.min(e.w,this.w)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this.z=Math.max(t,Math.min(e,this.z)),this.w=Math.max(t,Math.min(e,this.w)),this}clampLength(t,e){const n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this.w=t.w+(e.w-t.w)*n,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}}class rx extends mr{constructor(t=1,e=1,n={}){super(),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=1,this.scissor=new ze(0,0,t,e),this.scissorTest=!1,this.viewport=new ze(0,0,t,e);const s={width:t,height:e,depth:1};n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Bi,depthBuffer:!0,stencilBuffer:!1,resolveDepthBuffer:!0,resolveStencilBuffer:!0,depthTexture:null,samples:0,count:1},n);const r=new kn(s,n.mapping,n.wrapS,n.wrapT,n.magFilter,n.minFilter,n.format,n.type,n.anisotropy,n.colorSpace);r.flipY=!1,r.generateMipmaps=n.generateMipmaps,r.internalFormat=n.internalFormat,this.textures=[];const o=n.count;for(let a=0;a<o;a++)this.textures[a]=r.clone(),this.textures[a].isRenderTargetTexture=!0;this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.depthTexture=n.depthTexture,this.samples=n.samples}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}setSize(t,e,n=1){if(this.width!==t||this.height!==e||this.depth!==n){this.width=t,this.height=e,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=n;this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let n=0,s=t.textures.length;n<s;n++)this.textures[n]=t.textures[n].clone(),this.textures[n].isRenderTargetTexture=!0;const e=Object.assign({},t.texture.image);return this.texture.source=new qm(e),this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,t.depthTexture!==null&&(this.depthTexture=t.depthTexture.clone()),this.samples=t.samples,this}dispose(){this.dispatchEvent({type:"dispose"})}}class Cs extends rx{constructor(t=1,e=1,n={}){super(t,e,n),this.isWebGLRenderTarget=!0}}class jm extends kn{constructor(t=null,e=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=Cn,this.minFilter=Cn,this.wrapR=rr,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}}class ox extends kn{constructor(t=null,e=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=Cn,this.minFilter=Cn,this.wrapR=rr,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}}class Ls{constructor(t=0,e=0,n=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=n,this._w=s}static slerpFlat(t,e,n,s,r,o,a){let l=n[s+0],c=n[s+1],h=n[s+2],u=n[s+3];const f=r[o+0],p=r[o+1],_=r[o+2],b=r[o+3];if(a===0){t[e+0]=l,t[e+1]=c,t[e+2]=h,t[e+3]=u;return}if(a===1){t[e+0]=f,t[e+1]=p,t[e+2]=_,t[e+3]=b;return}if(u!==b||l!==f||c!==p||h!==_){let m=1-a;const d=l*f+c*p+h*_+u*b,S=d>=0?1:-1,E=1-d*d;if(E>Number.EPSILON){const U=Math.sqrt(E),P=Math.atan2(U,d*S);m=Math.sin(m*P)/U,a=Math.sin(a*P)/U}const v=a*S;if(l=l*m+f*v,c=c*m+p*v,h=h*m+_*v,u=u*m+b*v,m===1-a){const U=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=U,c*=U,h*=U,u*=U}}t[e]=l,t[e+1]=c,t[e+2]=h,t[e+3]=u}static multiplyQuaternionsFlat(t,e,n,s,r,o){const a=n[s],l=n[s+1],c=n[s+2],h=n[s+3],u=r[o],f=r[o+1],p=r[o+2],_=r[o+3];return t[e]=a*_+h*u+l*p-c*f,t[e+1]=l*_+h*f+c*u-a*p,t[e+2]=c*_+h*p+a*f-l*u,t[e+3]=h*_-a*u-l*f-c*p,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,n,s){return this._x=t,this._y=e,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){const n=t._x,s=t._y,r=t._z,o=t._order,a=Math.cos,l=Math.sin,c=a(n/2),h=a(s/2),u=a(r/2),f=l(n/2),p=l(s/2),_=l(r/2);switch(o){case"XYZ":this._x=f*h*u+c*p*_,this._y=c*p*u-f*h*_,this._z=c*h*_+f*p*u,this._w=c*h*u-f*p*_;break;case"YXZ":this._x=f*h*u+c*p*_,this._y=c*p*u-f*h*_,this._z=c*h*_-f*p*u,this._w=c*h*u+f*p*_;break;case"ZXY":this._x=f*h*u-c*p*_,this._y=c*p*u+f*h*_,this._z=c*h*_+f*p*u,this._w=c*h*u-f*p*_;break;case"ZYX":this._x=f*h*u-c*p*_,this._y=c*p*u+f*h*_,this._z=c*h*_-f*p*u,this._w=c*h*u+f*p*_;break;case"YZX":this._x=f*h*u+c*p*_,this._y=c*p*u+f*h*_,this._z=c*h*_-f*p*u,this._w=c*h*u-f*p*_;break;case"XZY":this._x=f*h*u-c*p*_,this._y=c*p*u-f*h*_,this._z=c*h*_+f*p*u,this._w=c*h*u+f*p*_;break;default:console.warn("THREE.Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){const n=e/2,s=Math.sin(n);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(t){const e=t.elements,n=e[0],s=e[4],r=e[8],o=e[1],a=e[5],l=e[9],c=e[2],h=e[6],u=e[10],f=n+a+u;if(f>0){const p=.5/Math.sqrt(f+1);this._w=.25/p,this._x=(h-l)*p,this._y=(r-c)*p,this._z=(o-s)*p}else if(n>a&&n>u){const p=2*Math.sqrt(1+n-a-u);this._w=(h-l)/p,this._x=.25*p,this._y=(s+o)/p,this._z=(r+c)/p}else if(a>u){const p=2*Math.sqrt(1+a-n-u);this._w=(r-c)/p,this._x=(s+o)/p,this._y=.25*p,this._z=(l+h)/p}else{const p=2*Math.sqrt(1+u-n-a);this._w=(o-s)/p,this._x=(r+c)/p,this._y=(l+h)/p,this._z=.25*p}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let n=t.dot(e)+1;return n<Number.EPSILON?(n=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=n):(this._x=0,this._y=-t.z,this._z=t.y,this._w=n)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=n),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(Rn(this.dot(t),-1,1)))}rotateTowards(t,e){const n=this.angleTo(t);if(n===0)return this;const s=Math.min(1,e/n);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){const n=t._x,s=t._y,r=t._z,o=t._w,a=e._x,l=e._y,c=e._z,h=e._w;return this._x=n*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-n*c,this._z=r*h+o*c+n*l-s*a,this._w=o*h-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(t,e){if(e===0)return this;if(e===1)return this.copy(t);const n=this._x,s=this._y,r=this._z,o=this._w;let a=o*t._w+n*t._x+s*t._y+r*t._z;if(a<0?(this._w=-t._w,this._x=-t._x,this._y=-t._y,this._z=-t._z,a=-a):this.copy(t),a>=1)return this._w=o,this._x=n,this._y=s,this._z=r,this;const l=1-a*a;if(l<=Number.EPSILON){const p=1-e;return this._w=p*o+e*this._w,this._x=p*n+e*this._x,this._y=p*s+e*this._y,this._z=p*r+e*this._z,this.normalize(),this}const c=Math.sqrt(l),h=Math.atan2(c,a),u=Math.sin((1-e)*h)/c,f=Math.sin(e*h)/c;return this._w=o*u+this._w*f,this._x=n*u+this._x*f,this._y=s*u+this._y*f,this._z=r*u+this._z*f,this._onChangeCallback(),this}slerpQuaternions(t,e,n){return this.copy(t).slerp(e,n)}random(){const t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}}class D{constructor(t=0,e=0,n=0){D.prototype.isVector3=!0,this.x=t,this.y=e,this.z=n}set(t,e,n){return n===void 0&&(n=this.z),this.x=t,this.y=e,this.z=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(vd.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(vd.setFromAxisAngle(t,e))}applyMatrix3(t){const e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*n+r[6]*s,this.y=r[1]*e+r[4]*n+r[7]*s,this.z=r[2]*e+r[5]*n+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){const e=this.x,n=this.y,s=this.z,r=t.elements,o=1/(r[3]*e+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*e+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*e+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(t){const e=this.x,n=this.y,s=this.z,r=t.x,o=t.y,a=t.z,l=t.w,c=2*(o*s-a*n),h=2*(a*e-r*s),u=2*(r*n-o*e);return this.x=e+l*c+o*u-a*h,this.y=n+l*h+a*c-r*u,this.z=s+l*u+r*h-o*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){const e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*n+r[8]*s,this.y=r[1]*e+r[5]*n+r[9]*s,this.z=r[2]*e+r[6]*n+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=Math.max(t.x,Math.min(e.x,this.x)),this.y=Math.max(t.y,Math.min(e.y,this.y)),this.z=Math.max(t.z,Math.min(e.z,this.z)),this}clampScalar(t,e){return this.x=Math.max(t,Math.min(e,this.x)),this.y=Math.max(t,Math.min(e,this.y)),this.z=Math.max(t,Math.min(e,this.z)),this}clampLength(t,e){const n=this.length();return this.divideScalar(n||1).multiplyScalar(Math.max(t,Math.min(e,n)))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){const n=t.x,s=t.y,r=t.z,o=e.x,a=e.y,l=e.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(t){const e=t.lengthSq();if(e===0)return this.set(0,0,0);const n=t.dot(this)/e;return this.copy(t).multiplyScalar(n)}projectOnPlane(t){return mc.copy(this).projectOnVector(t),this.sub(mc)}reflect(t){return this.sub(mc.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){const e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;const n=this.dot(t)/e;return Math.acos(Rn(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){const e=this.x-t.x,n=this.y-t.y,s=this.z-t.z;return e*e+n*n+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,n){const s=Math.sin(e)*t;return this.x=s*Math.sin(n),this.y=Math.cos(e)*t,this.z=s*Math.cos(n),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,n){return this.x=t*Math.sin(e),this.y=n,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){const e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){const e=this.setFromMatrixColumn(t,0).length(),n=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=n,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){const t=Math.random()*Math.PI*2,e=Math.random()*2-1,n=Math.sqrt(1-e*e);return this.x=n*Math.cos(t),this.y=e,this.z=n*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}}const mc=new D,vd=new Ls;class Fs{constructor(t=new D(1/0,1/0,1/0),e=new D(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e+=3)this.expandByPoint(mi.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,n=t.count;e<n;e++)this.expandByPoint(mi.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){const n=mi.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(n),this.max.copy(t).add(n),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);const n=t.geometry;if(n!==void 0){const r=n.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,mi):mi.fromBufferAttribute(r,o),mi.applyMatrix4(t.matrixWorld),this.expandByPoint(mi);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),_a.copy(t.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),_a.copy(n.boundingBox)),_a.applyMatrix4(t.matrixWorld),this.union(_a)}const s=t.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,mi),mi.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,n;return t.normal.x>0?(e=t.normal.x*this.min.x,n=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,n=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,n+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,n+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,n+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,n+=t.normal.z*this.min.z),e<=-t.constant&&n>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(Lo),ga.subVectors(this.max,Lo),Lr.subVectors(t.a,Lo),Ir.subVectors(t.b,Lo),Fr.subVectors(t.c,Lo),ms.subVectors(Ir,Lr),_s.subVectors(Fr,Ir),Vs.subVectors(Lr,Fr);let e=[0,-ms.z,ms.y,0,-_s.z,_s.y,0,-Vs.z,Vs.y,ms.z,0,-ms.x,_s.z,0,-_s.x,Vs.z,0,-Vs.x,-ms.y,ms.x,0,-_s.y,_s.x,0,-Vs.y,Vs.x,0];return!_c(e,Lr,Ir,Fr,ga)||(e=[1,0,0,0,1,0,0,0,1],!_c(e,Lr,Ir,Fr,ga))?!1:(ba.crossVectors(ms,_s),e=[ba.x,ba.y,ba.z],_c(e,Lr,Ir,Fr,ga))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,mi).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(mi).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(Wi[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),Wi[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),Wi[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),Wi[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),Wi[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),Wi[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),Wi[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),Wi[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(Wi),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}}const Wi=[new D,new D,new D,new D,new D,new D,new D,new D],mi=new D,_a=new Fs,Lr=new D,Ir=new D,Fr=new D,ms=new D,_s=new D,Vs=new D,Lo=new D,ga=new D,ba=new D,Hs=new D;function _c(i,t,e,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){Hs.fromArray(i,r);const a=s.x*Math.abs(Hs.x)+s.y*Math.abs(Hs.y)+s.z*Math.abs(Hs.z),l=t.dot(Hs),c=e.dot(Hs),h=n.dot(Hs);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}const ax=new Fs,Io=new D,gc=new D;class _r{constructor(t=new D,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){const n=this.center;e!==void 0?n.copy(e):ax.setFromPoints(t).getCenter(n);let s=0;for(let r=0,o=t.length;r<o;r++)s=Math.max(s,n.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){const e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){const n=this.center.distanceToSquared(t);return e.copy(t),n>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;Io.subVectors(t,this.center);const e=Io.lengthSq();if(e>this.radius*this.radius){const n=Math.sqrt(e),s=(n-this.radius)*.5;this.center.addScaledVector(Io,s/n),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(gc.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(Io.copy(t.center).add(gc)),this.expandByPoint(Io.copy(t.center).sub(gc))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}}const Xi=new D,bc=new D,va=new D,gs=new D,vc=new D,xa=new D,xc=new D;class Bl{constructor(t=new D,e=new D(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,Xi)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);const n=e.dot(this.direction);return n<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){const e=Xi.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(Xi.copy(this.origin).addScaledVector(this.direction,e),Xi.distanceToSquared(t))}distanceSqToSegment(t,e,n,s){bc.copy(t).add(e).multiplyScalar(.5),va.copy(e).sub(t).normalize(),gs.copy(this.origin).sub(bc);const r=t.distanceTo(e)*.5,o=-this.direction.dot(va),a=gs.dot(this.direction),l=-gs.dot(va),c=gs.lengthSq(),h=Math.abs(1-o*o);let u,f,p,_;if(h>0)if(u=o*l-a,f=o*a-l,_=r*h,u>=0)if(f>=-_)if(f<=_){const b=1/h;u*=b,f*=b,p=u*(u+o*f+2*a)+f*(o*u+f+2*l)+c}else f=r,u=Math.max(0,-(o*f+a)),p=-u*u+f*(f+2*l)+c;else f=-r,u=Math.max(0,-(o*f+a)),p=-u*u+f*(f+2*l)+c;else f<=-_?(u=Math.max(0,-(-o*r+a)),f=u>0?-r:Math.min(Math.max(-r,-l),r),p=-u*u+f*(f+2*l)+c):f<=_?(u=0,f=Math.min(Math.max(-r,-l),r),p=f*(f+2*l)+c):(u=Math.max(0,-(o*r+a)),f=u>0?r:Math.min(Math.max(-r,-l),r),p=-u*u+f*(f+2*l)+c);else f=o>0?-r:r,u=Math.max(0,-(o*f+a)),p=-u*u+f*(f+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(bc).addScaledVector(va,f),p}intersectSphere(t,e){Xi.subVectors(t.center,this.origin);const n=Xi.dot(this.direction),s=Xi.dot(Xi)-n*n,r=t.radius*t.radius;if(s>r)return null;const o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,e):this.at(a,e)}intersectsSphere(t){return this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){const e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;const n=-(this.origin.dot(t.normal)+t.constant)/e;return n>=0?n:null}intersectPlane(t,e){const n=this.distanceToPlane(t);return n===null?null:this.at(n,e)}intersectsPlane(t){const e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let n,s,r,o,a,l;const c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,f=this.origin;return c>=0?(n=(t.min.x-f.x)*c,s=(t.max.x-f.x)*c):(n=(t.max.x-f.x)*c,s=(t.min.x-f.x)*c),h>=0?(r=(t.min.y-f.y)*h,o=(t.max.y-f.y)*h):(r=(t.max.y-f.y)*h,o=(t.min.y-f.y)*h),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(t.min.z-f.z)*u,l=(t.max.z-f.z)*u):(a=(t.max.z-f.z)*u,l=(t.min.z-f.z)*u),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,e)}intersectsBox(t){return this.intersectBox(t,Xi)!==null}intersectTriangle(t,e,n,s,r){vc.subVectors(e,t),xa.subVectors(n,t),xc.crossVectors(vc,xa);let o=this.direction.dot(xc),a;if(o>0){if(s)return null;a=1}else if(o<0)a=-1,o=-o;else return null;gs.subVectors(this.origin,t);const l=a*this.direction.dot(xa.crossVectors(gs,xa));if(l<0)return null;const c=a*this.direction.dot(vc.cross(gs));if(c<0||l+c>o)return null;const h=-a*gs.dot(xc);return h<0?null:this.at(h/o,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}}class Re{constructor(t,e,n,s,r,o,a,l,c,h,u,f,p,_,b,m){Re.prototype.isMatrix4=!0,this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c,h,u,f,p,_,b,m)}set(t,e,n,s,r,o,a,l,c,h,u,f,p,_,b,m){const d=this.elements;return d[0]=t,d[4]=e,d[8]=n,d[12]=s,d[1]=r,d[5]=o,d[9]=a,d[13]=l,d[2]=c,d[6]=h,d[10]=u,d[14]=f,d[3]=p,d[7]=_,d[11]=b,d[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new Re().fromArray(this.elements)}copy(t){const e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],e[9]=n[9],e[10]=n[10],e[11]=n[11],e[12]=n[12],e[13]=n[13],e[14]=n[14],e[15]=n[15],this}copyPosition(t){const e=this.elements,n=t.elements;return e[12]=n[12],e[13]=n[13],e[14]=n[14],this}setFromMatrix3(t){const e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,n){return t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this}makeBasis(t,e,n){return this.set(t.x,e.x,n.x,0,t.y,e.y,n.y,0,t.z,e.z,n.z,0,0,0,0,1),this}extractRotation(t){const e=this.elements,n=t.elements,s=1/Dr.setFromMatrixColumn(t,0).length(),r=1/Dr.setFromMatrixColumn(t,1).length(),o=1/Dr.setFromMatrixColumn(t,2).length();return e[0]=n[0]*s,e[1]=n[1]*s,e[2]=n[2]*s,e[3]=0,e[4]=n[4]*r,e[5]=n[5]*r,e[6]=n[6]*r,e[7]=0,e[8]=n[8]*o,e[9]=n[9]*o,e[10]=n[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){const e=this.elements,n=t.x,s=t.y,r=t.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){const f=o*h,p=o*u,_=a*h,b=a*u;e[0]=l*h,e[4]=-l*u,e[8]=c,e[1]=p+_*c,e[5]=f-b*c,e[9]=-a*l,e[2]=b-f*c,e[6]=_+p*c,e[10]=o*l}else if(t.order==="YXZ"){const f=l*h,p=l*u,_=c*h,b=c*u;e[0]=f+b*a,e[4]=_*a-p,e[8]=o*c,e[1]=o*u,e[5]=o*h,e[9]=-a,e[2]=p*a-_,e[6]=b+f*a,e[10]=o*l}else if(t.order==="ZXY"){const f=l*h,p=l*u,_=c*h,b=c*u;e[0]=f-b*a,e[4]=-o*u,e[8]=_+p*a,e[1]=p+_*a,e[5]=o*h,e[9]=b-f*a,e[2]=-o*c,e[6]=a,e[10]=o*l}else if(t.order==="ZYX"){const f=o*h,p=o*u,_=a*h,b=a*u;e[0]=l*h,e[4]=_*c-p,e[8]=f*c+b,e[1]=l*u,e[5]=b*c+f,e[9]=p*c-_,e[2]=-c,e[6]=a*l,e[10]=o*l}else if(t.order==="YZX"){const f=o*l,p=o*c,_=a*l,b=a*c;e[0]=l*h,e[4]=b-f*u,e[8]=_*u+p,e[1]=u,e[5]=o*h,e[9]=-a*h,e[2]=-c*h,e[6]=p*u+_,e[10]=f-b*u}else if(t.order==="XZY"){const f=o*l,p=o*c,_=a*l,b=a*c;e[0]=l*h,e[4]=-u,e[8]=c*h,e[1]=f*u+b,e[5]=o*h,e[9]=p*u-_,e[2]=_*u-p,e[6]=a*h,e[10]=b*u+f}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(lx,t,cx)}lookAt(t,e,n){const s=this.elements;return jn.subVectors(t,e),jn.lengthSq()===0&&(jn.z=1),jn.normalize(),bs.crossVectors(n,jn),bs.lengthSq()===0&&(Math.abs(n.z)===1?jn.x+=1e-4:jn.z+=1e-4,jn.normalize(),bs.crossVectors(n,jn)),bs.normalize(),Ma.crossVectors(jn,bs),s[0]=bs.x,s[4]=Ma.x,s[8]=jn.x,s[1]=bs.y,s[5]=Ma.y,s[9]=jn.y,s[2]=bs.z,s[6]=Ma.z,s[10]=jn.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){const n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],h=n[1],u=n[5],f=n[9],p=n[13],_=n[2],b=n[6],m=n[10],d=n[14],S=n[3],E=n[7],v=n[11],U=n[15],P=s[0],I=s[4],F=s[8],w=s[12],x=s[1],R=s[5],G=s[9],O=s[13],$=s[2],Y=s[6],J=s[10],K=s[14],et=s[3],ft=s[7],ht=s[11],_t=s[15];return r[0]=o*P+a*x+l*$+c*et,r[4]=o*I+a*R+l*Y+c*ft,r[8]=o*F+a*G+l*J+c*ht,r[12]=o*w+a*O+l*K+c*_t,r[1]=h*P+u*x+f*$+p*et,r[5]=h*I+u*R+f*Y+p*ft,r[9]=h*F+u*G+f*J+p*ht,r[13]=h*w+u*O+f*K+p*_t,r[2]=_*P+b*x+m*$+d*et,r[6]=_*I+b*R+m*Y+d*ft,r[10]=_*F+b*G+m*J+d*ht,r[14]=_*w+b*O+m*K+d*_t,r[3]=S*P+E*x+v*$+U*et,r[7]=S*I+E*R+v*Y+U*ft,r[11]=S*F+E*G+v*J+U*ht,r[15]=S*w+E*O+v*K+U*_t,this}multiplyScalar(t){const e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){const t=this.elements,e=t[0],n=t[4],s=t[8],r=t[12],o=t[1],a=t[5],l=t[9],c=t[13],h=t[2],u=t[6],f=t[10],p=t[14],_=t[3],b=t[7],m=t[11],d=t[15];return _*(+r*l*u-s*c*u-r*a*f+n*c*f+s*a*p-n*l*p)+b*(+e*l*p-e*c*f+r*o*f-s*o*p+s*c*h-r*l*h)+m*(+e*c*u-e*a*p-r*o*u+n*o*p+r*a*h-n*c*h)+d*(-s*a*h-e*l*u+e*a*f+s*o*u-n*o*f+n*l*h)}transpose(){const t=this.elements;let e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,n){const s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=n),this}invert(){const t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=t[9],f=t[10],p=t[11],_=t[12],b=t[13],m=t[14],d=t[15],S=u*m*c-b*f*c+b*l*p-a*m*p-u*l*d+a*f*d,E=_*f*c-h*m*c-_*l*p+o*m*p+h*l*d-o*f*d,v=h*b*c-_*u*c+_*a*p-o*b*p-h*a*d+o*u*d,U=_*u*l-h*b*l-_*a*f+o*b*f+h*a*m-o*u*m,P=e*S+n*E+s*v+r*U;if(P===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);const I=1/P;return t[0]=S*I,t[1]=(b*f*r-u*m*r-b*s*p+n*m*p+u*s*d-n*f*d)*I,t[2]=(a*m*r-b*l*r+b*s*c-n*m*c-a*s*d+n*l*d)*I,t[3]=(u*l*r-a*f*r-u*s*c+n*f*c+a*s*p-n*l*p)*I,t[4]=E*I,t[5]=(h*m*r-_*f*r+_*s*p-e*m*p-h*s*d+e*f*d)*I,t[6]=(_*l*r-o*m*r-_*s*c+e*m*c+o*s*d-e*l*d)*I,t[7]=(o*f*r-h*l*r+h*s*c-e*f*c-o*s*p+e*l*p)*I,t[8]=v*I,t[9]=(_*u*r-h*b*r-_*n*p+e*b*p+h*n*d-e*u*d)*I,t[10]=(o*b*r-_*a*r+_*n*c-e*b*c-o*n*d+e*a*d)*I,t[11]=(h*a*r-o*u*r-h*n*c+e*u*c+o*n*p-e*a*p)*I,t[12]=U*I,t[13]=(h*b*s-_*u*s+_*n*f-e*b*f-h*n*m+e*u*m)*I,t[14]=(_*a*s-o*b*s-_*n*l+e*b*l+o*n*m-e*a*m)*I,t[15]=(o*u*s-h*a*s+h*n*l-e*u*l-o*n*f+e*a*f)*I,this}scale(t){const e=this.elements,n=t.x,s=t.y,r=t.z;return e[0]*=n,e[4]*=s,e[8]*=r,e[1]*=n,e[5]*=s,e[9]*=r,e[2]*=n,e[6]*=s,e[10]*=r,e[3]*=n,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){const t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],n=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,n,s))}makeTranslation(t,e,n){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,n,0,0,0,1),this}makeRotationX(t){const e=Math.cos(t),n=Math.sin(t);return this.set(1,0,0,0,0,e,-n,0,0,n,e,0,0,0,0,1),this}makeRotationY(t){const e=Math.cos(t),n=Math.sin(t);return this.set(e,0,n,0,0,1,0,0,-n,0,e,0,0,0,0,1),this}makeRotationZ(t){const e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,0,n,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){const n=Math.cos(e),s=Math.sin(e),r=1-n,o=t.x,a=t.y,l=t.z,c=r*o,h=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+n,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(t,e,n){return this.set(t,0,0,0,0,e,0,0,0,0,n,0,0,0,0,1),this}makeShear(t,e,n,s,r,o){return this.set(1,n,r,0,t,1,o,0,e,s,1,0,0,0,0,1),this}compose(t,e,n){const s=this.elements,r=e._x,o=e._y,a=e._z,l=e._w,c=r+r,h=o+o,u=a+a,f=r*c,p=r*h,_=r*u,b=o*h,m=o*u,d=a*u,S=l*c,E=l*h,v=l*u,U=n.x,P=n.y,I=n.z;return s[0]=(1-(b+d))*U,s[1]=(p+v)*U,s[2]=(_-E)*U,s[3]=0,s[4]=(p-v)*P,s[5]=(1-(f+d))*P,s[6]=(m+S)*P,s[7]=0,s[8]=(_+E)*I,s[9]=(m-S)*I,s[10]=(1-(f+b))*I,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,n){const s=this.elements;let r=Dr.set(s[0],s[1],s[2]).length();const o=Dr.set(s[4],s[5],s[6]).length(),a=Dr.set(s[8],s[9],s[10]).length();this.determinant()<0&&(r=-r),t.x=s[12],t.y=s[13],t.z=s[14],_i.copy(this);const c=1/r,h=1/o,u=1/a;return _i.elements[0]*=c,_i.elements[1]*=c,_i.elements[2]*=c,_i.elements[4]*=h,_i.elements[5]*=h,_i.elements[6]*=h,_i.elements[8]*=u,_i.elements[9]*=u,_i.elements[10]*=u,e.setFromRotationMatrix(_i),n.x=r,n.y=o,n.z=a,this}makePerspective(t,e,n,s,r,o,a=ns){const l=this.elements,c=2*r/(e-t),h=2*r/(n-s),u=(e+t)/(e-t),f=(n+s)/(n-s);let p,_;if(a===ns)p=-(o+r)/(o-r),_=-2*o*r/(o-r);else if(a===vl)p=-o/(o-r),_=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return l[0]=c,l[4]=0,l[8]=u,l[12]=0,l[1]=0,l[5]=h,l[9]=f,l[13]=0,l[2]=0,l[6]=0,l[10]=p,l[14]=_,l[3]=0,l[7]=0,l[11]=-1,l[15]=0,this}makeOrthographic(t,e,n,s,r,o,a=ns){const l=this.elements,c=1/(e-t),h=1/(n-s),u=1/(o-r),f=(e+t)*c,p=(n+s)*h;let _,b;if(a===ns)_=(o+r)*u,b=-2*u;else if(a===vl)_=r*u,b=-1*u;else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return l[0]=2*c,l[4]=0,l[8]=0,l[12]=-f,l[1]=0,l[5]=2*h,l[9]=0,l[13]=-p,l[2]=0,l[6]=0,l[10]=b,l[14]=-_,l[3]=0,l[7]=0,l[11]=0,l[15]=1,this}equals(t){const e=this.elements,n=t.elements;for(let s=0;s<16;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<16;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){const n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t[e+9]=n[9],t[e+10]=n[10],t[e+11]=n[11],t[e+12]=n[12],t[e+13]=n[13],t[e+14]=n[14],t[e+15]=n[15],t}}const Dr=new D,_i=new Re,lx=new D(0,0,0),cx=new D(1,1,1),bs=new D,Ma=new D,jn=new D,xd=new Re,Md=new Ls;class Ei{constructor(t=0,e=0,n=0,s=Ei.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=n,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,n,s=this._order){return this._x=t,this._y=e,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,n=!0){const s=t.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],u=s[2],f=s[6],p=s[10];switch(e){case"XYZ":this._y=Math.asin(Rn(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,p),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(f,c),this._z=0);break;case"YXZ":this._x=Math.asin(-Rn(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,p),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(Rn(f,-1,1)),Math.abs(f)<.9999999?(this._y=Math.atan2(-u,p),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-Rn(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(f,p),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(Rn(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,p));break;case"XZY":this._z=Math.asin(-Rn(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(f,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,p),this._y=0);break;default:console.warn("THREE.Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,n===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,n){return xd.makeRotationFromQuaternion(t),this.setFromRotationMatrix(xd,e,n)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return Md.setFromEuler(this),this.setFromQuaternion(Md,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}}Ei.DEFAULT_ORDER="XYZ";class $m{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}}let hx=0;const Sd=new D,Ur=new Ls,Yi=new Re,Sa=new D,Fo=new D,ux=new D,fx=new Ls,yd=new D(1,0,0),wd=new D(0,1,0),Ed=new D(0,0,1),Td={type:"added"},dx={type:"removed"},Nr={type:"childadded",child:null},Mc={type:"childremoved",child:null};class vn extends mr{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:hx++}),this.uuid=ea(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=vn.DEFAULT_UP.clone();const t=new D,e=new Ei,n=new Ls,s=new D(1,1,1);function r(){n.setFromEuler(e,!1)}function o(){e.setFromQuaternion(n,void 0,!1)}e._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Re},normalMatrix:{value:new te}}),this.matrix=new Re,this.matrixWorld=new Re,this.matrixAutoUpdate=vn.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=vn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new $m,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.userData={}}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return Ur.setFromAxisAngle(t,e),this.quaternion.multiply(Ur),this}rotateOnWorldAxis(t,e){return Ur.setFromAxisAngle(t,e),this.quaternion.premultiply(Ur),this}rotateX(t){return this.rotateOnAxis(yd,t)}rotateY(t){return this.rotateOnAxis(wd,t)}rotateZ(t){return this.rotateOnAxis(Ed,t)}translateOnAxis(t,e){return Sd.copy(t).applyQuaternion(this.quaternion),this.position.add(Sd.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(yd,t)}translateY(t){return this.translateOnAxis(wd,t)}translateZ(t){return this.translateOnAxis(Ed,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(Yi.copy(this.matrixWorld).invert())}lookAt(t,e,n){t.isVector3?Sa.copy(t):Sa.set(t,e,n);const s=this.parent;this.updateWorldMatrix(!0,!1),Fo.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Yi.lookAt(Fo,Sa,this.up):Yi.lookAt(Sa,Fo,this.up),this.quaternion.setFromRotationMatrix(Yi),s&&(Yi.extractRotation(s.matrixWorld),Ur.setFromRotationMatrix(Yi),this.quaternion.premultiply(Ur.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(console.error("THREE.Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(Td),Nr.child=t,this.dispatchEvent(Nr),Nr.child=null):console.error("THREE.Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}const e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(dx),Mc.child=t,this.dispatchEvent(Mc),Mc.child=null),this}removeFromParent(){const t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),Yi.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),Yi.multiply(t.parent.matrixWorld)),t.applyMatrix4(Yi),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(Td),Nr.child=t,this.dispatchEvent(Nr),Nr.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let n=0,s=this.children.length;n<s;n++){const o=this.children[n].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,n=[]){this[t]===e&&n.push(this);const s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(t,e,n);return n}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Fo,t,ux),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Fo,fx,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);const e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}traverse(t){t(this);const e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);const e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverseVisible(t)}traverseAncestors(t){const e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale),this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);const e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].updateMatrixWorld(t)}updateWorldMatrix(t,e){const n=this.parent;if(t===!0&&n!==null&&n.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),e===!0){const s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].updateWorldMatrix(!1,!0)}}toJSON(t){const e=t===void 0||typeof t=="string",n={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.6,type:"Object",generator:"Object3D.toJSON"});const s={};s.uuid=this.uuid,s.type=this.type,this.name!==""&&(s.name=this.name),this.castShadow===!0&&(s.castShadow=!0),this.receiveShadow===!0&&(s.receiveShadow=!0),this.visible===!1&&(s.visible=!1),this.frustumCulled===!1&&(s.frustumCulled=!1),this.renderOrder!==0&&(s.renderOrder=this.renderOrder),Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.matrixAutoUpdate===!1&&(s.matrixAutoUpdate=!1),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.visibility=this._visibility,s.active=this._active,s.bounds=this._bounds.map(a=>({boxInitialized:a.boxInitialized,boxMin:a.box.min.toArray(),boxMax:a.box.max.toArray(),sphereInitialized:a.sphereInitialized,sphereRadius:a.sphere.radius,sphereCenter:a.sphere.center.toArray()})),s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.geometryCount=this._geometryCount,s.matricesTexture=this._matricesTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere={center:s.boundingSphere.center.toArray(),radius:s.boundingSphere.radius}),this.boundingBox!==null&&(s.boundingBox={min:s.boundingBox.min.toArray(),max:s.boundingBox.max.toArray()}));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);const a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){const l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){const u=l[c];r(t.shapes,u)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){const a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(t.materials,this.material[l]));s.material=a}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){const l=this.animations[a];s.animations.push(r(t.animations,l))}}if(e){const a=o(t.geometries),l=o(t.materials),c=o(t.textures),h=o(t.images),u=o(t.shapes),f=o(t.skeletons),p=o(t.animations),_=o(t.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),u.length>0&&(n.shapes=u),f.length>0&&(n.skeletons=f),p.length>0&&(n.animations=p),_.length>0&&(n.nodes=_)}return n.object=s,n;function o(a){const l=[];for(const c in a){const h=a[c];delete h.metadata,l.push(h)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let n=0;n<t.children.length;n++){const s=t.children[n];this.add(s.clone())}return this}}vn.DEFAULT_UP=new D(0,1,0);vn.DEFAULT_MATRIX_AUTO_UPDATE=!0;vn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;const gi=new D,qi=new D,Sc=new D,ji=new D,Or=new D,kr=new D,Ad=new D,yc=new D,wc=new D,Ec=new D,Tc=new ze,Ac=new ze,Rc=new ze;class hi{constructor(t=new D,e=new D,n=new D){this.a=t,this.b=e,this.c=n}static getNormal(t,e,n,s){s.subVectors(n,e),gi.subVectors(t,e),s.cross(gi);const r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,n,s,r){gi.subVectors(s,e),qi.subVectors(n,e),Sc.subVectors(t,e);const o=gi.dot(gi),a=gi.dot(qi),l=gi.dot(Sc),c=qi.dot(qi),h=qi.dot(Sc),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;const f=1/u,p=(c*l-a*h)*f,_=(o*h-a*l)*f;return r.set(1-p-_,_,p)}static containsPoint(t,e,n,s){return this.getBarycoord(t,e,n,s,ji)===null?!1:ji.x>=0&&ji.y>=0&&ji.x+ji.y<=1}static getInterpolation(t,e,n,s,r,o,a,l){return this.getBarycoord(t,e,n,s,ji)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,ji.x),l.addScaledVector(o,ji.y),l.addScaledVector(a,ji.z),l)}static getInterpolatedAttribute(t,e,n,s,r,o){return Tc.setScalar(0),Ac.setScalar(0),Rc.setScalar(0),Tc.fromBufferAttribute(t,e),Ac.fromBufferAttribute(t,n),Rc.fromBufferAttribute(t,s),o.setScalar(0),o.addScaledVector(Tc,r.x),o.addScaledVector(Ac,r.y),o.addScaledVector(Rc,r.z),o}static isFrontFacing(t,e,n,s){return gi.subVectors(n,e),qi.subVectors(t,e),gi.cross(qi).dot(s)<0}set(t,e,n){return this.a.copy(t),this.b.copy(e),this.c.copy(n),this}setFromPointsAndIndices(t,e,n,s){return this.a.copy(t[e]),this.b.copy(t[n]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,n,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,n),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return gi.subVectors(this.c,this.b),qi.subVectors(this.a,this.b),gi.cross(qi).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return hi.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return hi.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,n,s,r){return hi.getInterpolation(t,this.a,this.b,this.c,e,n,s,r)}containsPoint(t){return hi.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return hi.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){const n=this.a,s=this.b,r=this.c;let o,a;Or.subVectors(s,n),kr.subVectors(r,n),yc.subVectors(t,n);const l=Or.dot(yc),c=kr.dot(yc);if(l<=0&&c<=0)return e.copy(n);wc.subVectors(t,s);const h=Or.dot(wc),u=kr.dot(wc);if(h>=0&&u<=h)return e.copy(s);const f=l*u-h*c;if(f<=0&&l>=0&&h<=0)return o=l/(l-h),e.copy(n).addScaledVector(Or,o);Ec.subVectors(t,r);const p=Or.dot(Ec),_=kr.dot(Ec);if(_>=0&&p<=_)return e.copy(r);const b=p*c-l*_;if(b<=0&&c>=0&&_<=0)return a=c/(c-_),e.copy(n).addScaledVector(kr,a);const m=h*_-p*u;if(m<=0&&u-h>=0&&p-_>=0)return Ad.subVectors(r,s),a=(u-h)/(u-h+(p-_)),e.copy(s).addScaledVector(Ad,a);const d=1/(m+b+f);return o=b*d,a=f*d,e.copy(n).addScaledVector(Or,o).addScaledVector(kr,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}}const Zm={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},vs={h:0,s:0,l:0},ya={h:0,s:0,l:0};function Pc(i,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?i+(t-i)*6*e:e<1/2?t:e<2/3?i+(t-i)*6*(2/3-e):i}class ie{constructor(t,e,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,n)}set(t,e,n){if(e===void 0&&n===void 0){const s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,n);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=ai){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,ue.toWorkingColorSpace(this,e),this}setRGB(t,e,n,s=ue.workingColorSpace){return this.r=t,this.g=e,this.b=n,ue.toWorkingColorSpace(this,s),this}setHSL(t,e,n,s=ue.workingColorSpace){if(t=Zv(t,1),e=Rn(e,0,1),n=Rn(n,0,1),e===0)this.r=this.g=this.b=n;else{const r=n<=.5?n*(1+e):n+e-n*e,o=2*n-r;this.r=Pc(o,r,t+1/3),this.g=Pc(o,r,t),this.b=Pc(o,r,t-1/3)}return ue.toWorkingColorSpace(this,s),this}setStyle(t,e=ai){function n(r){r!==void 0&&parseFloat(r)<1&&console.warn("THREE.Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r;const o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+)\%\s*,\s*(\d+)\%\s*,\s*(\d+)\%\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseInt(r[1],10))/100,Math.min(100,parseInt(r[2],10))/100,Math.min(100,parseInt(r[3],10))/100,e);break;case"hsl":case"hsla":if(r=/^\s*(\d*\.?\d+)\s*,\s*(\d*\.?\d+)\%\s*,\s*(\d*\.?\d+)\%\s*(?:,\s*(\d*\.?\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:console.warn("THREE.Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){const r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);console.warn("THREE.Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=ai){const n=Zm[t.toLowerCase()];return n!==void 0?this.setHex(n,e):console.warn("THREE.Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=os(t.r),this.g=os(t.g),this.b=os(t.b),this}copyLinearToSRGB(t){return this.r=no(t.r),this.g=no(t.g),this.b=no(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=ai){return ue.fromWorkingColorSpace(Tn.copy(this),t),Math.round(Rn(Tn.r*255,0,255))*65536+Math.round(Rn(Tn.g*255,0,255))*256+Math.round(Rn(Tn.b*255,0,255))}getHexString(t=ai){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=ue.workingColorSpace){ue.fromWorkingColorSpace(Tn.copy(this),e);const n=Tn.r,s=Tn.g,r=Tn.b,o=Math.max(n,s,r),a=Math.min(n,s,r);let l,c;const h=(a+o)/2;if(a===o)l=0,c=0;else{const u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case n:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-n)/u+2;break;case r:l=(n-s)/u+4;break}l/=6}return t.h=l,t.s=c,t.l=h,t}getRGB(t,e=ue.workingColorSpace){return ue.fromWorkingColorSpace(Tn.copy(this),e),t.r=Tn.r,t.g=Tn.g,t.b=Tn.b,t}getStyle(t=ai){ue.fromWorkingColorSpace(Tn.copy(this),t);const e=Tn.r,n=Tn.g,s=Tn.b;return t!==ai?`color(${t} ${e.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(t,e,n){return this.getHSL(vs),this.setHSL(vs.h+t,vs.s+e,vs.l+n)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,n){return this.r=t.r+(e.r-t.r)*n,this.g=t.g+(e.g-t.g)*n,this.b=t.b+(e.b-t.b)*n,this}lerpHSL(t,e){this.getHSL(vs),t.getHSL(ya);const n=fc(vs.h,ya.h,e),s=fc(vs.s,ya.s,e),r=fc(vs.l,ya.l,e);return this.setHSL(n,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){const e=this.r,n=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*n+r[6]*s,this.g=r[1]*e+r[4]*n+r[7]*s,this.b=r[2]*e+r[5]*n+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}}const Tn=new ie;ie.NAMES=Zm;let px=0;class Ds extends mr{static get type(){return"Material"}get type(){return this.constructor.type}set type(t){}constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:px++}),this.uuid=ea(),this.name="",this.blending=to,this.side=as,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=mh,this.blendDst=_h,this.blendEquation=ir,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new ie(0,0,0),this.blendAlpha=0,this.depthFunc=co,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=ud,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Pr,this.stencilZFail=Pr,this.stencilZPass=Pr,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(const e in t){const n=t[e];if(n===void 0){console.warn(`THREE.Material: parameter '${e}' has value of undefined.`);continue}const s=this[e];if(s===void 0){console.warn(`THREE.Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[e]=n}}toJSON(t){const e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});const n={metadata:{version:4.6,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,this.name!==""&&(n.name=this.name),this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&this.emissiveIntensity!==1&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessRange!==void 0&&(n.iridescenceThicknessRange=this.iridescenceThicknessRange),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(t).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(t).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(t).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(t).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(t).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&this.attenuationDistance!==1/0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.shadowSide!==null&&(n.shadowSide=this.shadowSide),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),this.blending!==to&&(n.blending=this.blending),this.side!==as&&(n.side=this.side),this.vertexColors===!0&&(n.vertexColors=!0),this.opacity<1&&(n.opacity=this.opacity),this.transparent===!0&&(n.transparent=!0),this.blendSrc!==mh&&(n.blendSrc=this.blendSrc),this.blendDst!==_h&&(n.blendDst=this.blendDst),this.blendEquation!==ir&&(n.blendEquation=this.blendEquation),this.blendSrcAlpha!==null&&(n.blendSrcAlpha=this.blendSrcAlpha),this.blendDstAlpha!==null&&(n.blendDstAlpha=this.blendDstAlpha),this.blendEquationAlpha!==null&&(n.blendEquationAlpha=this.blendEquationAlpha),this.blendColor&&this.blendColor.isColor&&(n.blendColor=this.blendColor.getHex()),this.blendAlpha!==0&&(n.blendAlpha=this.blendAlpha),this.depthFunc!==co&&(n.depthFunc=this.depthFunc),this.depthTest===!1&&(n.depthTest=this.depthTest),this.depthWrite===!1&&(n.depthWrite=this.depthWrite),this.colorWrite===!1&&(n.colorWrite=this.colorWrite),this.stencilWriteMask!==255&&(n.stencilWriteMask=this.stencilWriteMask),this.stencilFunc!==ud&&(n.stencilFunc=this.stencilFunc),this.stencilRef!==0&&(n.stencilRef=this.stencilRef),this.stencilFuncMask!==255&&(n.stencilFuncMask=this.stencilFuncMask),this.stencilFail!==Pr&&(n.stencilFail=this.stencilFail),this.stencilZFail!==Pr&&(n.stencilZFail=this.stencilZFail),this.stencilZPass!==Pr&&(n.stencilZPass=this.stencilZPass),this.stencilWrite===!0&&(n.stencilWrite=this.stencilWrite),this.rotation!==void 0&&this.rotation!==0&&(n.rotation=this.rotation),this.polygonOffset===!0&&(n.polygonOffset=!0),this.polygonOffsetFactor!==0&&(n.polygonOffsetFactor=this.polygonOffsetFactor),this.polygonOffsetUnits!==0&&(n.polygonOffsetUnits=this.polygonOffsetUnits),this.linewidth!==void 0&&this.linewidth!==1&&(n.linewidth=this.linewidth),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.dithering===!0&&(n.dithering=!0),this.alphaTest>0&&(n.alphaTest=this.alphaTest),this.alphaHash===!0&&(n.alphaHash=!0),this.alphaToCoverage===!0&&(n.alphaToCoverage=!0),this.premultipliedAlpha===!0&&(n.premultipliedAlpha=!0),this.forceSinglePass===!0&&(n.forceSinglePass=!0),this.wireframe===!0&&(n.wireframe=!0),this.wireframeLinewidth>1&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!=="round"&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!=="round"&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading===!0&&(n.flatShading=!0),this.visible===!1&&(n.visible=!1),this.toneMapped===!1&&(n.toneMapped=!1),this.fog===!1&&(n.fog=!1),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){const o=[];for(const a in r){const l=r[a];delete l.metadata,o.push(l)}return o}if(e){const r=s(t.textures),o=s(t.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;const e=t.clippingPlanes;let n=null;if(e!==null){const s=e.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=e[r].clone()}return this.clippingPlanes=n,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}onBuild(){console.warn("Material: onBuild() has been removed.")}}class Km extends Ds{static get type(){return"MeshBasicMaterial"}constructor(t){super(),this.isMeshBasicMaterial=!0,this.color=new ie(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Ei,this.combine=Dl,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}}const je=new D,wa=new qt;class We{constructor(t,e,n=!1){if(Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=n,this.usage=fd,this.updateRanges=[],this.gpuType=yi,this.version=0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this}copyAt(t,e,n){t*=this.itemSize,n*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[n+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,n=this.count;e<n;e++)wa.fromBufferAttribute(this,e),wa.applyMatrix3(t),this.setXY(e,wa.x,wa.y);else if(this.itemSize===3)for(let e=0,n=this.count;e<n;e++)je.fromBufferAttribute(this,e),je.applyMatrix3(t),this.setXYZ(e,je.x,je.y,je.z);return this}applyMatrix4(t){for(let e=0,n=this.count;e<n;e++)je.fromBufferAttribute(this,e),je.applyMatrix4(t),this.setXYZ(e,je.x,je.y,je.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)je.fromBufferAttribute(this,e),je.applyNormalMatrix(t),this.setXYZ(e,je.x,je.y,je.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)je.fromBufferAttribute(this,e),je.transformDirection(t),this.setXYZ(e,je.x,je.y,je.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let n=this.array[t*this.itemSize+e];return this.normalized&&(n=Co(n,this.array)),n}setComponent(t,e,n){return this.normalized&&(n=Vn(n,this.array)),this.array[t*this.itemSize+e]=n,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=Co(e,this.array)),e}setX(t,e){return this.normalized&&(e=Vn(e,this.array)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=Co(e,this.array)),e}setY(t,e){return this.normalized&&(e=Vn(e,this.array)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=Co(e,this.array)),e}setZ(t,e){return this.normalized&&(e=Vn(e,this.array)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=Co(e,this.array)),e}setW(t,e){return this.normalized&&(e=Vn(e,this.array)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,n){return t*=this.itemSize,this.normalized&&(e=Vn(e,this.array),n=Vn(n,this.array)),this.array[t+0]=e,this.array[t+1]=n,this}setXYZ(t,e,n,s){return t*=this.itemSize,this.normalized&&(e=Vn(e,this.array),n=Vn(n,this.array),s=Vn(s,this.array)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this}setXYZW(t,e,n,s,r){return t*=this.itemSize,this.normalized&&(e=Vn(e,this.array),n=Vn(n,this.array),s=Vn(s,this.array),r=Vn(r,this.array)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){const t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return this.name!==""&&(t.name=this.name),this.usage!==fd&&(t.usage=this.usage),t}}class Jm extends We{constructor(t,e,n){super(new Uint16Array(t),e,n)}}class Qm extends We{constructor(t,e,n){super(new Uint32Array(t),e,n)}}class Qe extends We{constructor(t,e,n){super(new Float32Array(t),e,n)}}let mx=0;const ii=new Re,Cc=new vn,Br=new D,$n=new Fs,Do=new Fs,bn=new D;class xn extends mr{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:mx++}),this.uuid=ea(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={}}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(Ym(t)?Qm:Jm)(t,1):this.index=t,this}setIndirect(t){return this.indirect=t,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,n=0){this.groups.push({start:t,count:e,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){const e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);const n=this.attributes.normal;if(n!==void 0){const r=new te().getNormalMatrix(t);n.applyNormalMatrix(r),n.needsUpdate=!0}const s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this}applyQuaternion(t){return ii.makeRotationFromQuaternion(t),this.applyMatrix4(ii),this}rotateX(t){return ii.makeRotationX(t),this.applyMatrix4(ii),this}rotateY(t){return ii.makeRotationY(t),this.applyMatrix4(ii),this}rotateZ(t){return ii.makeRotationZ(t),this.applyMatrix4(ii),this}translate(t,e,n){return ii.makeTranslation(t,e,n),this.applyMatrix4(ii),this}scale(t,e,n){return ii.makeScale(t,e,n),this.applyMatrix4(ii),this}lookAt(t){return Cc.lookAt(t),Cc.updateMatrix(),this.applyMatrix4(Cc.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(Br).negate(),this.translate(Br.x,Br.y,Br.z),this}setFromPoints(t){const e=this.getAttribute("position");if(e===void 0){const n=[];for(let s=0,r=t.length;s<r;s++){const o=t[s];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new Qe(n,3))}else{for(let n=0,s=e.count;n<s;n++){const r=t[n];e.setXYZ(n,r.x,r.y,r.z||0)}t.length>e.count&&console.warn("THREE.BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Fs);const t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){console.error("THREE.BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new D(-1/0,-1/0,-1/0),new D(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let n=0,s=e.length;n<s;n++){const r=e[n];$n.setFromBufferAttribute(r),this.morphTargetsRelative?(bn.addVectors(this.boundingBox.min,$n.min),this.boundingBox.expandByPoint(bn),bn.addVectors(this.boundingBox.max,$n.max),this.boundingBox.expandByPoint(bn)):(this.boundingBox.expandByPoint($n.min),this.boundingBox.expandByPoint($n.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&console.error('THREE.BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new _r);const t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){console.error("THREE.BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new D,1/0);return}if(t){const n=this.boundingSphere.center;if($n.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){const a=e[r];Do.setFromBufferAttribute(a),this.morphTargetsRelative?(bn.addVectors($n.min,Do.min),$n.expandByPoint(bn),bn.addVectors($n.max,Do.max),$n.expandByPoint(bn)):($n.expandByPoint(Do.min),$n.expandByPoint(Do.max))}$n.getCenter(n);let s=0;for(let r=0,o=t.count;r<o;r++)bn.fromBufferAttribute(t,r),s=Math.max(s,n.distanceToSquared(bn));if(e)for(let r=0,o=e.length;r<o;r++){const a=e[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)bn.fromBufferAttribute(a,c),l&&(Br.fromBufferAttribute(t,c),bn.add(Br)),s=Math.max(s,n.distanceToSquared(bn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&console.error('THREE.BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){const t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){console.error("THREE.BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}const n=e.position,s=e.normal,r=e.uv;this.hasAttribute("tangent")===!1&&this.setAttribute("tangent",new We(new Float32Array(4*n.count),4));const o=this.getAttribute("tangent"),a=[],l=[];for(let F=0;F<n.count;F++)a[F]=new D,l[F]=new D;const c=new D,h=new D,u=new D,f=new qt,p=new qt,_=new qt,b=new D,m=new D;function d(F,w,x){c.fromBufferAttribute(n,F),h.fromBufferAttribute(n,w),u.fromBufferAttribute(n,x),f.fromBufferAttribute(r,F),p.fromBufferAttribute(r,w),_.fromBufferAttribute(r,x),h.sub(c),u.sub(c),p.sub(f),_.sub(f);const R=1/(p.x*_.y-_.x*p.y);isFinite(R)&&(b.copy(h).multiplyScalar(_.y).addScaledVector(u,-p.y).multiplyScalar(R),m.copy(u).multiplyScalar(p.x).addScaledVector(h,-_.x).multiplyScalar(R),a[F].add(b),a[w].add(b),a[x].add(b),l[F].add(m),l[w].add(m),l[x].add(m))}let S=this.groups;S.length===0&&(S=[{start:0,count:t.count}]);for(let F=0,w=S.length;F<w;++F){const x=S[F],R=x.start,G=x.count;for(let O=R,$=R+G;O<$;O+=3)d(t.getX(O+0),t.getX(O+1),t.getX(O+2))}const E=new D,v=new D,U=new D,P=new D;function I(F){U.fromBufferAttribute(s,F),P.copy(U);const w=a[F];E.copy(w),E.sub(U.multiplyScalar(U.dot(w))).normalize(),v.crossVectors(P,w);const R=v.dot(l[F])<0?-1:1;o.setXYZW(F,E.x,E.y,E.z,R)}for(let F=0,w=S.length;F<w;++F){const x=S[F],R=x.start,G=x.count;for(let O=R,$=R+G;O<$;O+=3)I(t.getX(O+0)),I(t.getX(O+1)),I(t.getX(O+2))}}computeVertexNormals(){const t=this.index,e=this.getAttribute("position");if(e!==void 0){let n=this.getAttribute("normal");if(n===void 0)n=new We(new Float32Array(e.count*3),3),this.setAttribute("normal",n);else for(let f=0,p=n.count;f<p;f++)n.setXYZ(f,0,0,0);const s=new D,r=new D,o=new D,a=new D,l=new D,c=new D,h=new D,u=new D;if(t)for(let f=0,p=t.count;f<p;f+=3){const _=t.getX(f+0),b=t.getX(f+1),m=t.getX(f+2);s.fromBufferAttribute(e,_),r.fromBufferAttribute(e,b),o.fromBufferAttribute(e,m),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(n,_),l.fromBufferAttribute(n,b),c.fromBufferAttribute(n,m),a.add(h),l.add(h),c.add(h),n.setXYZ(_,a.x,a.y,a.z),n.setXYZ(b,l.x,l.y,l.z),n.setXYZ(m,c.x,c.y,c.z)}else for(let f=0,p=e.count;f<p;f+=3)s.fromBufferAttribute(e,f+0),r.fromBufferAttribute(e,f+1),o.fromBufferAttribute(e,f+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),n.setXYZ(f+0,h.x,h.y,h.z),n.setXYZ(f+1,h.x,h.y,h.z),n.setXYZ(f+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){const t=this.attributes.normal;for(let e=0,n=t.count;e<n;e++)bn.fromBufferAttribute(t,e),bn.normalize(),t.setXYZ(e,bn.x,bn.y,bn.z)}toNonIndexed(){function t(a,l){const c=a.array,h=a.itemSize,u=a.normalized,f=new c.constructor(l.length*h);let p=0,_=0;for(let b=0,m=l.length;b<m;b++){a.isInterleavedBufferAttribute?p=l[b]*a.data.stride+a.offset:p=l[b]*h;for(let d=0;d<h;d++)f[_++]=c[p++]}return new We(f,h,u)}if(this.index===null)return console.warn("THREE.BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;const e=new xn,n=this.index.array,s=this.attributes;for(const a in s){const l=s[a],c=t(l,n);e.setAttribute(a,c)}const r=this.morphAttributes;for(const a in r){const l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){const f=c[h],p=t(f,n);l.push(p)}e.morphAttributes[a]=l}e.morphTargetsRelative=this.morphTargetsRelative;const o=this.groups;for(let a=0,l=o.length;a<l;a++){const c=o[a];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){const t={metadata:{version:4.6,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.type,this.name!==""&&(t.name=this.name),Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0){const l=this.parameters;for(const c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};const e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});const n=this.attributes;for(const l in n){const c=n[l];t.data.attributes[l]=c.toJSON(t.data)}const s={};let r=!1;for(const l in this.morphAttributes){const c=this.morphAttributes[l],h=[];for(let u=0,f=c.length;u<f;u++){const p=c[u];h.push(p.toJSON(t.data))}h.length>0&&(s[l]=h,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);const o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));const a=this.boundingSphere;return a!==null&&(t.data.boundingSphere={center:a.center.toArray(),radius:a.radius}),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;const e={};this.name=t.name;const n=t.index;n!==null&&this.setIndex(n.clone(e));const s=t.attributes;for(const c in s){const h=s[c];this.setAttribute(c,h.clone(e))}const r=t.morphAttributes;for(const c in r){const h=[],u=r[c];for(let f=0,p=u.length;f<p;f++)h.push(u[f].clone(e));this.morphAttributes[c]=h}this.morphTargetsRelative=t.morphTargetsRelative;const o=t.groups;for(let c=0,h=o.length;c<h;c++){const u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}const a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());const l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this}dispose(){this.dispatchEvent({type:"dispose"})}}const Rd=new Re,Gs=new Bl,Ea=new _r,Pd=new D,Ta=new D,Aa=new D,Ra=new D,Lc=new D,Pa=new D,Cd=new D,Ca=new D;class an extends vn{constructor(t=new xn,e=new Km){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0&&(this.morphTargetInfluences=t.morphTargetInfluences.slice()),t.morphTargetDictionary!==void 0&&(this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary)),this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){const e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){const s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){const a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){const n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;e.fromBufferAttribute(s,t);const a=this.morphTargetInfluences;if(r&&a){Pa.set(0,0,0);for(let l=0,c=r.length;l<c;l++){const h=a[l],u=r[l];h!==0&&(Lc.fromBufferAttribute(u,t),o?Pa.addScaledVector(Lc,h):Pa.addScaledVector(Lc.sub(e),h))}e.add(Pa)}return e}raycast(t,e){const n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),Ea.copy(n.boundingSphere),Ea.applyMatrix4(r),Gs.copy(t.ray).recast(t.near),!(Ea.containsPoint(Gs.origin)===!1&&(Gs.intersectSphere(Ea,Pd)===null||Gs.origin.distanceToSquared(Pd)>(t.far-t.near)**2))&&(Rd.copy(r).invert(),Gs.copy(t.ray).applyMatrix4(Rd),!(n.boundingBox!==null&&Gs.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(t,e,Gs)))}_computeIntersections(t,e,n){let s;const r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,f=r.groups,p=r.drawRange;if(a!==null)if(Array.isArray(o))for(let _=0,b=f.length;_<b;_++){const m=f[_],d=o[m.materialIndex],S=Math.max(m.start,p.start),E=Math.min(a.count,Math.min(m.start+m.count,p.start+p.count));for(let v=S,U=E;v<U;v+=3){const P=a.getX(v),I=a.getX(v+1),F=a.getX(v+2);s=La(this,d,t,n,c,h,u,P,I,F),s&&(s.faceIndex=Math.floor(v/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{const _=Math.max(0,p.start),b=Math.min(a.count,p.start+p.count);for(let m=_,d=b;m<d;m+=3){const S=a.getX(m),E=a.getX(m+1),v=a.getX(m+2);s=La(this,o,t,n,c,h,u,S,E,v),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let _=0,b=f.length;_<b;_++){const m=f[_],d=o[m.materialIndex],S=Math.max(m.start,p.start),E=Math.min(l.count,Math.min(m.start+m.count,p.start+p.count));for(let v=S,U=E;v<U;v+=3){const P=v,I=v+1,F=v+2;s=La(this,d,t,n,c,h,u,P,I,F),s&&(s.faceIndex=Math.floor(v/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{const _=Math.max(0,p.start),b=Math.min(l.count,p.start+p.count);for(let m=_,d=b;m<d;m+=3){const S=m,E=m+1,v=m+2;s=La(this,o,t,n,c,h,u,S,E,v),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}}}function _x(i,t,e,n,s,r,o,a){let l;if(t.side===Gn?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,t.side===as,a),l===null)return null;Ca.copy(a),Ca.applyMatrix4(i.matrixWorld);const c=e.ray.origin.distanceTo(Ca);return c<e.near||c>e.far?null:{distance:c,point:Ca.clone(),object:i}}function La(i,t,e,n,s,r,o,a,l,c){i.getVertexPosition(a,Ta),i.getVertexPosition(l,Aa),i.getVertexPosition(c,Ra);const h=_x(i,t,e,n,Ta,Aa,Ra,Cd);if(h){const u=new D;hi.getBarycoord(Cd,Ta,Aa,Ra,u),s&&(h.uv=hi.getInterpolatedAttribute(s,a,l,c,u,new qt)),r&&(h.uv1=hi.getInterpolatedAttribute(r,a,l,c,u,new qt)),o&&(h.normal=hi.getInterpolatedAttribute(o,a,l,c,u,new D),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));const f={a,b:l,c,normal:new D,materialIndex:0};hi.getNormal(Ta,Aa,Ra,f.normal),h.face=f,h.barycoord=u}return h}class xo extends xn{constructor(t=1,e=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};const a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);const l=[],c=[],h=[],u=[];let f=0,p=0;_("z","y","x",-1,-1,n,e,t,o,r,0),_("z","y","x",1,-1,n,e,-t,o,r,1),_("x","z","y",1,1,t,n,e,s,o,2),_("x","z","y",1,-1,t,n,-e,s,o,3),_("x","y","z",1,-1,t,e,n,s,r,4),_("x","y","z",-1,-1,t,e,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new Qe(c,3)),this.setAttribute("normal",new Qe(h,3)),this.setAttribute("uv",new Qe(u,2));function _(b,m,d,S,E,v,U,P,I,F,w){const x=v/I,R=U/F,G=v/2,O=U/2,$=P/2,Y=I+1,J=F+1;let K=0,et=0;const ft=new D;for(let ht=0;ht<J;ht++){const _t=ht*R-O;for(let Mt=0;Mt<Y;Mt++){const mt=Mt*x-G;ft[b]=mt*S,ft[m]=_t*E,ft[d]=$,c.push(ft.x,ft.y,ft.z),ft[b]=0,ft[m]=0,ft[d]=P>0?1:-1,h.push(ft.x,ft.y,ft.z),u.push(Mt/I),u.push(1-ht/F),K+=1}}for(let ht=0;ht<F;ht++)for(let _t=0;_t<I;_t++){const Mt=f+_t+Y*ht,mt=f+_t+Y*(ht+1),st=f+(_t+1)+Y*(ht+1),lt=f+(_t+1)+Y*ht;l.push(Mt,mt,lt),l.push(mt,st,lt),et+=6}a.addGroup(p,et,w),p+=et,f+=K}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new xo(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}}function mo(i){const t={};for(const e in i){t[e]={};for(const n in i[e]){const s=i[e][n];s&&(s.isColor||s.isMatrix3||s.isMatrix4||s.isVector2||s.isVector3||s.isVector4||s.isTexture||s.isQuaternion)?s.isRenderTargetTexture?(console.warn("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][n]=null):t[e][n]=s.clone():Array.isArray(s)?t[e][n]=s.slice():t[e][n]=s}}return t}function Un(i){const t={};for(let e=0;e<i.length;e++){const n=mo(i[e]);for(const s in n)t[s]=n[s]}return t}function gx(i){const t=[];for(let e=0;e<i.length;e++)t.push(i[e].clone());return t}function t_(i){const t=i.getRenderTarget();return t===null?i.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:ue.workingColorSpace}const bx={clone:mo,merge:Un};var vx=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,xx=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`;class cs extends Ds{static get type(){return"ShaderMaterial"}constructor(t){super(),this.isShaderMaterial=!0,this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=vx,this.fragmentShader=xx,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=mo(t.uniforms),this.uniformsGroups=gx(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this}toJSON(t){const e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(const s in this.uniforms){const o=this.uniforms[s].value;o&&o.isTexture?e.uniforms[s]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[s]={type:"m4",value:o.toArray()}:e.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;const n={};for(const s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(e.extensions=n),e}}class Iu extends vn{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Re,this.projectionMatrix=new Re,this.projectionMatrixInverse=new Re,this.coordinateSystem=ns}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorldInverse.copy(this.matrixWorld).invert()}updateWorldMatrix(t,e){super.updateWorldMatrix(t,e),this.matrixWorldInverse.copy(this.matrixWorld).invert()}clone(){return new this.constructor().copy(this)}}const xs=new D,Ld=new qt,Id=new qt;class ci extends Iu{constructor(t=50,e=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){const e=.5*this.getFilmHeight()/t;this.fov=tu*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){const t=Math.tan(Ja*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return tu*2*Math.atan(Math.tan(Ja*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,n){xs.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(xs.x,xs.y).multiplyScalar(-t/xs.z),xs.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(xs.x,xs.y).multiplyScalar(-t/xs.z)}getViewSize(t,e){return this.getViewBounds(t,Ld,Id),e.subVectors(Id,Ld)}setViewOffset(t,e,n,s,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){const t=this.near;let e=t*Math.tan(Ja*.5*this.fov)/this.zoom,n=2*e,s=this.aspect*n,r=-.5*s;const o=this.view;if(this.view!==null&&this.view.enabled){const l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,e-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}const a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-n,t,this.far,this.coordinateSystem),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){const e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}}const zr=-90,Vr=1;class Mx extends vn{constructor(t,e,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;const s=new ci(zr,Vr,t,e);s.layers=this.layers,this.add(s);const r=new ci(zr,Vr,t,e);r.layers=this.layers,this.add(r);const o=new ci(zr,Vr,t,e);o.layers=this.layers,this.add(o);const a=new ci(zr,Vr,t,e);a.layers=this.layers,this.add(a);const l=new ci(zr,Vr,t,e);l.layers=this.layers,this.add(l);const c=new ci(zr,Vr,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){const t=this.coordinateSystem,e=this.children.concat(),[n,s,r,o,a,l]=e;for(const c of e)this.remove(c);if(t===ns)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===vl)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(const c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();const{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());const[r,o,a,l,c,h]=this.children,u=t.getRenderTarget(),f=t.getActiveCubeFace(),p=t.getActiveMipmapLevel(),_=t.xr.enabled;t.xr.enabled=!1;const b=n.texture.generateMipmaps;n.texture.generateMipmaps=!1,t.setRenderTarget(n,0,s),t.render(e,r),t.setRenderTarget(n,1,s),t.render(e,o),t.setRenderTarget(n,2,s),t.render(e,a),t.setRenderTarget(n,3,s),t.render(e,l),t.setRenderTarget(n,4,s),t.render(e,c),n.texture.generateMipmaps=b,t.setRenderTarget(n,5,s),t.render(e,h),t.setRenderTarget(u,f,p),t.xr.enabled=_,n.texture.needsPMREMUpdate=!0}}class e_ extends kn{constructor(t,e,n,s,r,o,a,l,c,h){t=t!==void 0?t:[],e=e!==void 0?e:ho,super(t,e,n,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}}class Sx extends Cs{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;const n={width:t,height:t,depth:1},s=[n,n,n,n,n,n];this.texture=new e_(s,e.mapping,e.wrapS,e.wrapT,e.magFilter,e.minFilter,e.format,e.type,e.anisotropy,e.colorSpace),this.texture.isRenderTargetTexture=!0,this.texture.generateMipmaps=e.generateMipmaps!==void 0?e.generateMipmaps:!1,this.texture.minFilter=e.minFilter!==void 0?e.minFilter:Bi}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;const n={uniforms:{tEquirect:{value:null}},vertexShader:`

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
			`},s=new xo(5,5,5),r=new cs({name:"CubemapFromEquirect",uniforms:mo(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:Gn,blending:rs});r.uniforms.tEquirect.value=e;const o=new an(s,r),a=e.minFilter;return e.minFilter===or&&(e.minFilter=Bi),new Mx(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e,n,s){const r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,n,s);t.setRenderTarget(r)}}const Ic=new D,yx=new D,wx=new te;class es{constructor(t=new D(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,n,s){return this.normal.set(t,e,n),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,n){const s=Ic.subVectors(n,e).cross(yx.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){const t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e){const n=t.delta(Ic),s=this.normal.dot(n);if(s===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;const r=-(t.start.dot(this.normal)+this.constant)/s;return r<0||r>1?null:e.copy(t.start).addScaledVector(n,r)}intersectsLine(t){const e=this.distanceToPoint(t.start),n=this.distanceToPoint(t.end);return e<0&&n>0||n<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){const n=e||wx.getNormalMatrix(t),s=this.coplanarPoint(Ic).applyMatrix4(t),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}}const Ws=new _r,Ia=new D;class Fu{constructor(t=new es,e=new es,n=new es,s=new es,r=new es,o=new es){this.planes=[t,e,n,s,r,o]}set(t,e,n,s,r,o){const a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(t){const e=this.planes;for(let n=0;n<6;n++)e[n].copy(t.planes[n]);return this}setFromProjectionMatrix(t,e=ns){const n=this.planes,s=t.elements,r=s[0],o=s[1],a=s[2],l=s[3],c=s[4],h=s[5],u=s[6],f=s[7],p=s[8],_=s[9],b=s[10],m=s[11],d=s[12],S=s[13],E=s[14],v=s[15];if(n[0].setComponents(l-r,f-c,m-p,v-d).normalize(),n[1].setComponents(l+r,f+c,m+p,v+d).normalize(),n[2].setComponents(l+o,f+h,m+_,v+S).normalize(),n[3].setComponents(l-o,f-h,m-_,v-S).normalize(),n[4].setComponents(l-a,f-u,m-b,v-E).normalize(),e===ns)n[5].setComponents(l+a,f+u,m+b,v+E).normalize();else if(e===vl)n[5].setComponents(a,u,b,E).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),Ws.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{const e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),Ws.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(Ws)}intersectsSprite(t){return Ws.center.set(0,0,0),Ws.radius=.7071067811865476,Ws.applyMatrix4(t.matrixWorld),this.intersectsSphere(Ws)}intersectsSphere(t){const e=this.planes,n=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(t){const e=this.planes;for(let n=0;n<6;n++){const s=e[n];if(Ia.x=s.normal.x>0?t.max.x:t.min.x,Ia.y=s.normal.y>0?t.max.y:t.min.y,Ia.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(Ia)<0)return!1}return!0}containsPoint(t){const e=this.planes;for(let n=0;n<6;n++)if(e[n].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}}function n_(){let i=null,t=!1,e=null,n=null;function s(r,o){e(r,o),n=i.requestAnimationFrame(s)}return{start:function(){t!==!0&&e!==null&&(n=i.requestAnimationFrame(s),t=!0)},stop:function(){i.cancelAnimationFrame(n),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){i=r}}}function Ex(i){const t=new WeakMap;function e(a,l){const c=a.array,h=a.usage,u=c.byteLength,f=i.createBuffer();i.bindBuffer(l,f),i.bufferData(l,c,h),a.onUploadCallback();let p;if(c instanceof Float32Array)p=i.FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?p=i.HALF_FLOAT:p=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)p=i.SHORT;else if(c instanceof Uint32Array)p=i.UNSIGNED_INT;else if(c instanceof Int32Array)p=i.INT;else if(c instanceof Int8Array)p=i.BYTE;else if(c instanceof Uint8Array)p=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)p=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:f,type:p,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function n(a,l,c){const h=l.array,u=l.updateRanges;if(i.bindBuffer(c,a),u.length===0)i.bufferSubData(c,0,h);else{u.sort((p,_)=>p.start-_.start);let f=0;for(let p=1;p<u.length;p++){const _=u[f],b=u[p];b.start<=_.start+_.count+1?_.count=Math.max(_.count,b.start+b.count-_.start):(++f,u[f]=b)}u.length=f+1;for(let p=0,_=u.length;p<_;p++){const b=u[p];i.bufferSubData(c,b.start*h.BYTES_PER_ELEMENT,h,b.start,b.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);const l=t.get(a);l&&(i.deleteBuffer(l.buffer),t.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){const h=t.get(a);(!h||h.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}const c=t.get(a);if(c===void 0)t.set(a,e(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}class zl extends xn{constructor(t=1,e=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:n,heightSegments:s};const r=t/2,o=e/2,a=Math.floor(n),l=Math.floor(s),c=a+1,h=l+1,u=t/a,f=e/l,p=[],_=[],b=[],m=[];for(let d=0;d<h;d++){const S=d*f-o;for(let E=0;E<c;E++){const v=E*u-r;_.push(v,-S,0),b.push(0,0,1),m.push(E/a),m.push(1-d/l)}}for(let d=0;d<l;d++)for(let S=0;S<a;S++){const E=S+c*d,v=S+c*(d+1),U=S+1+c*(d+1),P=S+1+c*d;p.push(E,v,P),p.push(v,U,P)}this.setIndex(p),this.setAttribute("position",new Qe(_,3)),this.setAttribute("normal",new Qe(b,3)),this.setAttribute("uv",new Qe(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new zl(t.width,t.height,t.widthSegments,t.heightSegments)}}var Tx=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,Ax=`#ifdef USE_ALPHAHASH
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
#endif`,Rx=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,Px=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Cx=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,Lx=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,Ix=`#ifdef USE_AOMAP
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
#endif`,Fx=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,Dx=`#ifdef USE_BATCHING
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
#endif`,Ux=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,Nx=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,Ox=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,kx=`float G_BlinnPhong_Implicit( ) {
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
} // validated`,Bx=`#ifdef USE_IRIDESCENCE
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
#endif`,zx=`#ifdef USE_BUMPMAP
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
#endif`,Vx=`#if NUM_CLIPPING_PLANES > 0
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
#endif`,Hx=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,Gx=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,Wx=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Xx=`#if defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#elif defined( USE_COLOR )
	diffuseColor.rgb *= vColor;
#endif`,Yx=`#if defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#elif defined( USE_COLOR )
	varying vec3 vColor;
#endif`,qx=`#if defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#elif defined( USE_COLOR ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec3 vColor;
#endif`,jx=`#if defined( USE_COLOR_ALPHA )
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
#endif`,$x=`#define PI 3.141592653589793
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
} // validated`,Zx=`#ifdef ENVMAP_TYPE_CUBE_UV
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
#endif`,Kx=`vec3 transformedNormal = objectNormal;
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
#endif`,Jx=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,Qx=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,tM=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,eM=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,nM="gl_FragColor = linearToOutputTexel( gl_FragColor );",iM=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,sM=`#ifdef USE_ENVMAP
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
#endif`,rM=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform float flipEnvMap;
	uniform mat3 envMapRotation;
	#ifdef ENVMAP_TYPE_CUBE
		uniform samplerCube envMap;
	#else
		uniform sampler2D envMap;
	#endif
	
#endif`,oM=`#ifdef USE_ENVMAP
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
#endif`,aM=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,lM=`#ifdef USE_ENVMAP
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
#endif`,cM=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,hM=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,uM=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,fM=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,dM=`#ifdef USE_GRADIENTMAP
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
}`,pM=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,mM=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,_M=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,gM=`uniform bool receiveShadow;
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
#endif`,bM=`#ifdef USE_ENVMAP
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
#endif`,vM=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,xM=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,MM=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,SM=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,yM=`PhysicalMaterial material;
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
#endif`,wM=`struct PhysicalMaterial {
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
}`,EM=`
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
#endif`,TM=`#if defined( RE_IndirectDiffuse )
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
#endif`,AM=`#if defined( RE_IndirectDiffuse )
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,RM=`#if defined( USE_LOGDEPTHBUF )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,PM=`#if defined( USE_LOGDEPTHBUF )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,CM=`#ifdef USE_LOGDEPTHBUF
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,LM=`#ifdef USE_LOGDEPTHBUF
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,IM=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,FM=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,DM=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
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
#endif`,UM=`#if defined( USE_POINTS_UV )
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
#endif`,NM=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,OM=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,kM=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,BM=`#if defined( USE_MORPHCOLORS )
	vColor *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,zM=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,VM=`#ifdef USE_MORPHTARGETS
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
#endif`,HM=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,GM=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
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
vec3 nonPerturbedNormal = normal;`,WM=`#ifdef USE_NORMALMAP_OBJECTSPACE
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
#endif`,XM=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,YM=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,qM=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
	#endif
#endif`,jM=`#ifdef USE_NORMALMAP
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
#endif`,$M=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,ZM=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,KM=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,JM=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,QM=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,tS=`vec3 packNormalToRGB( const in vec3 normal ) {
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
}`,eS=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,nS=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,iS=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,sS=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,rS=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,oS=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,aS=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,lS=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,cS=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
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
#endif`,hS=`float getShadowMask() {
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
}`,uS=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,fS=`#ifdef USE_SKINNING
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
#endif`,dS=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,pS=`#ifdef USE_SKINNING
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
#endif`,mS=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,_S=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,gS=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,bS=`#ifndef saturate
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
vec3 CustomToneMapping( vec3 color ) { return color; }`,vS=`#ifdef USE_TRANSMISSION
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
#endif`,xS=`#ifdef USE_TRANSMISSION
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
#endif`,MS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,SS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,yS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,wS=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`;const ES=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,TS=`uniform sampler2D t2D;
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
}`,AS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,RS=`#ifdef ENVMAP_TYPE_CUBE
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
}`,PS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,CS=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,LS=`#include <common>
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
}`,IS=`#if DEPTH_PACKING == 3200
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
}`,FS=`#define DISTANCE
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
}`,DS=`#define DISTANCE
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
}`,US=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,NS=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,OS=`uniform float scale;
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
}`,kS=`uniform vec3 diffuse;
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
}`,BS=`#include <common>
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
}`,zS=`uniform vec3 diffuse;
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
}`,VS=`#define LAMBERT
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
}`,HS=`#define LAMBERT
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
}`,GS=`#define MATCAP
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
}`,WS=`#define MATCAP
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
}`,XS=`#define NORMAL
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
}`,YS=`#define NORMAL
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
}`,qS=`#define PHONG
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
}`,jS=`#define PHONG
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
}`,$S=`#define STANDARD
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
}`,ZS=`#define STANDARD
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
}`,KS=`#define TOON
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
}`,JS=`#define TOON
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
}`,QS=`uniform float size;
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
}`,ty=`uniform vec3 diffuse;
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
}`,ey=`#include <common>
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
}`,ny=`uniform vec3 color;
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
}`,iy=`uniform float rotation;
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
}`,sy=`uniform vec3 diffuse;
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
}`,ne={alphahash_fragment:Tx,alphahash_pars_fragment:Ax,alphamap_fragment:Rx,alphamap_pars_fragment:Px,alphatest_fragment:Cx,alphatest_pars_fragment:Lx,aomap_fragment:Ix,aomap_pars_fragment:Fx,batching_pars_vertex:Dx,batching_vertex:Ux,begin_vertex:Nx,beginnormal_vertex:Ox,bsdfs:kx,iridescence_fragment:Bx,bumpmap_pars_fragment:zx,clipping_planes_fragment:Vx,clipping_planes_pars_fragment:Hx,clipping_planes_pars_vertex:Gx,clipping_planes_vertex:Wx,color_fragment:Xx,color_pars_fragment:Yx,color_pars_vertex:qx,color_vertex:jx,common:$x,cube_uv_reflection_fragment:Zx,defaultnormal_vertex:Kx,displacementmap_pars_vertex:Jx,displacementmap_vertex:Qx,emissivemap_fragment:tM,emissivemap_pars_fragment:eM,colorspace_fragment:nM,colorspace_pars_fragment:iM,envmap_fragment:sM,envmap_common_pars_fragment:rM,envmap_pars_fragment:oM,envmap_pars_vertex:aM,envmap_physical_pars_fragment:bM,envmap_vertex:lM,fog_vertex:cM,fog_pars_vertex:hM,fog_fragment:uM,fog_pars_fragment:fM,gradientmap_pars_fragment:dM,lightmap_pars_fragment:pM,lights_lambert_fragment:mM,lights_lambert_pars_fragment:_M,lights_pars_begin:gM,lights_toon_fragment:vM,lights_toon_pars_fragment:xM,lights_phong_fragment:MM,lights_phong_pars_fragment:SM,lights_physical_fragment:yM,lights_physical_pars_fragment:wM,lights_fragment_begin:EM,lights_fragment_maps:TM,lights_fragment_end:AM,logdepthbuf_fragment:RM,logdepthbuf_pars_fragment:PM,logdepthbuf_pars_vertex:CM,logdepthbuf_vertex:LM,map_fragment:IM,map_pars_fragment:FM,map_particle_fragment:DM,map_particle_pars_fragment:UM,metalnessmap_fragment:NM,metalnessmap_pars_fragment:OM,morphinstance_vertex:kM,morphcolor_vertex:BM,morphnormal_vertex:zM,morphtarget_pars_vertex:VM,morphtarget_vertex:HM,normal_fragment_begin:GM,normal_fragment_maps:WM,normal_pars_fragment:XM,normal_pars_vertex:YM,normal_vertex:qM,normalmap_pars_fragment:jM,clearcoat_normal_fragment_begin:$M,clearcoat_normal_fragment_maps:ZM,clearcoat_pars_fragment:KM,iridescence_pars_fragment:JM,opaque_fragment:QM,packing:tS,premultiplied_alpha_fragment:eS,project_vertex:nS,dithering_fragment:iS,dithering_pars_fragment:sS,roughnessmap_fragment:rS,roughnessmap_pars_fragment:oS,shadowmap_pars_fragment:aS,shadowmap_pars_vertex:lS,shadowmap_vertex:cS,shadowmask_pars_fragment:hS,skinbase_vertex:uS,skinning_pars_vertex:fS,skinning_vertex:dS,skinnormal_vertex:pS,specularmap_fragment:mS,specularmap_pars_fragment:_S,tonemapping_fragment:gS,tonemapping_pars_fragment:bS,transmission_fragment:vS,transmission_pars_fragment:xS,uv_pars_fragment:MS,uv_pars_vertex:SS,uv_vertex:yS,worldpos_vertex:wS,background_vert:ES,background_frag:TS,backgroundCube_vert:AS,backgroundCube_frag:RS,cube_vert:PS,cube_frag:CS,depth_vert:LS,depth_frag:IS,distanceRGBA_vert:FS,distanceRGBA_frag:DS,equirect_vert:US,equirect_frag:NS,linedashed_vert:OS,linedashed_frag:kS,meshbasic_vert:BS,meshbasic_frag:zS,meshlambert_vert:VS,meshlambert_frag:HS,meshmatcap_vert:GS,meshmatcap_frag:WS,meshnormal_vert:XS,meshnormal_frag:YS,meshphong_vert:qS,meshphong_frag:jS,meshphysical_vert:$S,meshphysical_frag:ZS,meshtoon_vert:KS,meshtoon_frag:JS,points_vert:QS,points_frag:ty,shadow_vert:ey,shadow_frag:ny,sprite_vert:iy,sprite_frag:sy},Et={common:{diffuse:{value:new ie(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new te},alphaMap:{value:null},alphaMapTransform:{value:new te},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new te}},envmap:{envMap:{value:null},envMapRotation:{value:new te},flipEnvMap:{value:-1},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new te}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new te}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new te},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new te},normalScale:{value:new qt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new te},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new te}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new te}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new te}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new ie(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMap:{value:[]},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotShadowMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMap:{value:[]},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null}},points:{diffuse:{value:new ie(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new te},alphaTest:{value:0},uvTransform:{value:new te}},sprite:{diffuse:{value:new ie(16777215)},opacity:{value:1},center:{value:new qt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new te},alphaMap:{value:null},alphaMapTransform:{value:new te},alphaTest:{value:0}}},Oi={basic:{uniforms:Un([Et.common,Et.specularmap,Et.envmap,Et.aomap,Et.lightmap,Et.fog]),vertexShader:ne.meshbasic_vert,fragmentShader:ne.meshbasic_frag},lambert:{uniforms:Un([Et.common,Et.specularmap,Et.envmap,Et.aomap,Et.lightmap,Et.emissivemap,Et.bumpmap,Et.normalmap,Et.displacementmap,Et.fog,Et.lights,{emissive:{value:new ie(0)}}]),vertexShader:ne.meshlambert_vert,fragmentShader:ne.meshlambert_frag},phong:{uniforms:Un([Et.common,Et.specularmap,Et.envmap,Et.aomap,Et.lightmap,Et.emissivemap,Et.bumpmap,Et.normalmap,Et.displacementmap,Et.fog,Et.lights,{emissive:{value:new ie(0)},specular:{value:new ie(1118481)},shininess:{value:30}}]),vertexShader:ne.meshphong_vert,fragmentShader:ne.meshphong_frag},standard:{uniforms:Un([Et.common,Et.envmap,Et.aomap,Et.lightmap,Et.emissivemap,Et.bumpmap,Et.normalmap,Et.displacementmap,Et.roughnessmap,Et.metalnessmap,Et.fog,Et.lights,{emissive:{value:new ie(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:ne.meshphysical_vert,fragmentShader:ne.meshphysical_frag},toon:{uniforms:Un([Et.common,Et.aomap,Et.lightmap,Et.emissivemap,Et.bumpmap,Et.normalmap,Et.displacementmap,Et.gradientmap,Et.fog,Et.lights,{emissive:{value:new ie(0)}}]),vertexShader:ne.meshtoon_vert,fragmentShader:ne.meshtoon_frag},matcap:{uniforms:Un([Et.common,Et.bumpmap,Et.normalmap,Et.displacementmap,Et.fog,{matcap:{value:null}}]),vertexShader:ne.meshmatcap_vert,fragmentShader:ne.meshmatcap_frag},points:{uniforms:Un([Et.points,Et.fog]),vertexShader:ne.points_vert,fragmentShader:ne.points_frag},dashed:{uniforms:Un([Et.common,Et.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:ne.linedashed_vert,fragmentShader:ne.linedashed_frag},depth:{uniforms:Un([Et.common,Et.displacementmap]),vertexShader:ne.depth_vert,fragmentShader:ne.depth_frag},normal:{uniforms:Un([Et.common,Et.bumpmap,Et.normalmap,Et.displacementmap,{opacity:{value:1}}]),vertexShader:ne.meshnormal_vert,fragmentShader:ne.meshnormal_frag},sprite:{uniforms:Un([Et.sprite,Et.fog]),vertexShader:ne.sprite_vert,fragmentShader:ne.sprite_frag},background:{uniforms:{uvTransform:{value:new te},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:ne.background_vert,fragmentShader:ne.background_frag},backgroundCube:{uniforms:{envMap:{value:null},flipEnvMap:{value:-1},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new te}},vertexShader:ne.backgroundCube_vert,fragmentShader:ne.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:ne.cube_vert,fragmentShader:ne.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:ne.equirect_vert,fragmentShader:ne.equirect_frag},distanceRGBA:{uniforms:Un([Et.common,Et.displacementmap,{referencePosition:{value:new D},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:ne.distanceRGBA_vert,fragmentShader:ne.distanceRGBA_frag},shadow:{uniforms:Un([Et.lights,Et.fog,{color:{value:new ie(0)},opacity:{value:1}}]),vertexShader:ne.shadow_vert,fragmentShader:ne.shadow_frag}};Oi.physical={uniforms:Un([Oi.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new te},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new te},clearcoatNormalScale:{value:new qt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new te},dispersion:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new te},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new te},sheen:{value:0},sheenColor:{value:new ie(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new te},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new te},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new te},transmissionSamplerSize:{value:new qt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new te},attenuationDistance:{value:0},attenuationColor:{value:new ie(0)},specularColor:{value:new ie(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new te},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new te},anisotropyVector:{value:new qt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new te}}]),vertexShader:ne.meshphysical_vert,fragmentShader:ne.meshphysical_frag};const Fa={r:0,b:0,g:0},Xs=new Ei,ry=new Re;function oy(i,t,e,n,s,r,o){const a=new ie(0);let l=r===!0?0:1,c,h,u=null,f=0,p=null;function _(S){let E=S.isScene===!0?S.background:null;return E&&E.isTexture&&(E=(S.backgroundBlurriness>0?e:t).get(E)),E}function b(S){let E=!1;const v=_(S);v===null?d(a,l):v&&v.isColor&&(d(v,1),E=!0);const U=i.xr.getEnvironmentBlendMode();U==="additive"?n.buffers.color.setClear(0,0,0,1,o):U==="alpha-blend"&&n.buffers.color.setClear(0,0,0,0,o),(i.autoClear||E)&&(n.buffers.depth.setTest(!0),n.buffers.depth.setMask(!0),n.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function m(S,E){const v=_(E);v&&(v.isCubeTexture||v.mapping===Ul)?(h===void 0&&(h=new an(new xo(1,1,1),new cs({name:"BackgroundCubeMaterial",uniforms:mo(Oi.backgroundCube.uniforms),vertexShader:Oi.backgroundCube.vertexShader,fragmentShader:Oi.backgroundCube.fragmentShader,side:Gn,depthTest:!1,depthWrite:!1,fog:!1})),h.geometry.deleteAttribute("normal"),h.geometry.deleteAttribute("uv"),h.onBeforeRender=function(U,P,I){this.matrixWorld.copyPosition(I.matrixWorld)},Object.defineProperty(h.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),s.update(h)),Xs.copy(E.backgroundRotation),Xs.x*=-1,Xs.y*=-1,Xs.z*=-1,v.isCubeTexture&&v.isRenderTargetTexture===!1&&(Xs.y*=-1,Xs.z*=-1),h.material.uniforms.envMap.value=v,h.material.uniforms.flipEnvMap.value=v.isCubeTexture&&v.isRenderTargetTexture===!1?-1:1,h.material.uniforms.backgroundBlurriness.value=E.backgroundBlurriness,h.material.uniforms.backgroundIntensity.value=E.backgroundIntensity,h.material.uniforms.backgroundRotation.value.setFromMatrix4(ry.makeRotationFromEuler(Xs)),h.material.toneMapped=ue.getTransfer(v.colorSpace)!==Te,(u!==v||f!==v.version||p!==i.toneMapping)&&(h.material.needsUpdate=!0,u=v,f=v.version,p=i.toneMapping),h.layers.enableAll(),S.unshift(h,h.geometry,h.material,0,0,null)):v&&v.isTexture&&(c===void 0&&(c=new an(new zl(2,2),new cs({name:"BackgroundMaterial",uniforms:mo(Oi.background.uniforms),vertexShader:Oi.background.vertexShader,fragmentShader:Oi.background.fragmentShader,side:as,depthTest:!1,depthWrite:!1,fog:!1})),c.geometry.deleteAttribute("normal"),Object.defineProperty(c.material,"map",{get:function(){return this.uniforms.t2D.value}}),s.update(c)),c.material.uniforms.t2D.value=v,c.material.uniforms.backgroundIntensity.value=E.backgroundIntensity,c.material.toneMapped=ue.getTransfer(v.colorSpace)!==Te,v.matrixAutoUpdate===!0&&v.updateMatrix(),c.material.uniforms.uvTransform.value.copy(v.matrix),(u!==v||f!==v.version||p!==i.toneMapping)&&(c.material.needsUpdate=!0,u=v,f=v.version,p=i.toneMapping),c.layers.enableAll(),S.unshift(c,c.geometry,c.material,0,0,null))}function d(S,E){S.getRGB(Fa,t_(i)),n.buffers.color.setClear(Fa.r,Fa.g,Fa.b,E,o)}return{getClearColor:function(){return a},setClearColor:function(S,E=1){a.set(S),l=E,d(a,l)},getClearAlpha:function(){return l},setClearAlpha:function(S){l=S,d(a,l)},render:b,addToRenderList:m}}function ay(i,t){const e=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=f(null);let r=s,o=!1;function a(x,R,G,O,$){let Y=!1;const J=u(O,G,R);r!==J&&(r=J,c(r.object)),Y=p(x,O,G,$),Y&&_(x,O,G,$),$!==null&&t.update($,i.ELEMENT_ARRAY_BUFFER),(Y||o)&&(o=!1,v(x,R,G,O),$!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,t.get($).buffer))}function l(){return i.createVertexArray()}function c(x){return i.bindVertexArray(x)}function h(x){return i.deleteVertexArray(x)}function u(x,R,G){const O=G.wireframe===!0;let $=n[x.id];$===void 0&&($={},n[x.id]=$);let Y=$[R.id];Y===void 0&&(Y={},$[R.id]=Y);let J=Y[O];return J===void 0&&(J=f(l()),Y[O]=J),J}function f(x){const R=[],G=[],O=[];for(let $=0;$<e;$++)R[$]=0,G[$]=0,O[$]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:R,enabledAttributes:G,attributeDivisors:O,object:x,attributes:{},index:null}}function p(x,R,G,O){const $=r.attributes,Y=R.attributes;let J=0;const K=G.getAttributes();for(const et in K)if(K[et].location>=0){const ht=$[et];let _t=Y[et];if(_t===void 0&&(et==="instanceMatrix"&&x.instanceMatrix&&(_t=x.instanceMatrix),et==="instanceColor"&&x.instanceColor&&(_t=x.instanceColor)),ht===void 0||ht.attribute!==_t||_t&&ht.data!==_t.data)return!0;J++}return r.attributesNum!==J||r.index!==O}function _(x,R,G,O){const $={},Y=R.attributes;let J=0;const K=G.getAttributes();for(const et in K)if(K[et].location>=0){let ht=Y[et];ht===void 0&&(et==="instanceMatrix"&&x.instanceMatrix&&(ht=x.instanceMatrix),et==="instanceColor"&&x.instanceColor&&(ht=x.instanceColor));const _t={};_t.attribute=ht,ht&&ht.data&&(_t.data=ht.data),$[et]=_t,J++}r.attributes=$,r.attributesNum=J,r.index=O}function b(){const x=r.newAttributes;for(let R=0,G=x.length;R<G;R++)x[R]=0}function m(x){d(x,0)}function d(x,R){const G=r.newAttributes,O=r.enabledAttributes,$=r.attributeDivisors;G[x]=1,O[x]===0&&(i.enableVertexAttribArray(x),O[x]=1),$[x]!==R&&(i.vertexAttribDivisor(x,R),$[x]=R)}function S(){const x=r.newAttributes,R=r.enabledAttributes;for(let G=0,O=R.length;G<O;G++)R[G]!==x[G]&&(i.disableVertexAttribArray(G),R[G]=0)}function E(x,R,G,O,$,Y,J){J===!0?i.vertexAttribIPointer(x,R,G,$,Y):i.vertexAttribPointer(x,R,G,O,$,Y)}function v(x,R,G,O){b();const $=O.attributes,Y=G.getAttributes(),J=R.defaultAttributeValues;for(const K in Y){const et=Y[K];if(et.location>=0){let ft=$[K];if(ft===void 0&&(K==="instanceMatrix"&&x.instanceMatrix&&(ft=x.instanceMatrix),K==="instanceColor"&&x.instanceColor&&(ft=x.instanceColor)),ft!==void 0){const ht=ft.normalized,_t=ft.itemSize,Mt=t.get(ft);if(Mt===void 0)continue;const mt=Mt.buffer,st=Mt.type,lt=Mt.bytesPerElement,gt=st===i.INT||st===i.UNSIGNED_INT||ft.gpuType===Nl;if(ft.isInterleavedBufferAttribute){const at=ft.data,zt=at.stride,Ht=ft.offset;if(at.isInstancedInterleavedBuffer){for(let Ut=0;Ut<et.locationSize;Ut++)d(et.location+Ut,at.meshPerAttribute);x.isInstancedMesh!==!0&&O._maxInstanceCount===void 0&&(O._maxInstanceCount=at.meshPerAttribute*at.count)}else for(let Ut=0;Ut<et.locationSize;Ut++)m(et.location+Ut);i.bindBuffer(i.ARRAY_BUFFER,mt);for(let Ut=0;Ut<et.locationSize;Ut++)E(et.location+Ut,_t/et.locationSize,st,ht,zt*lt,(Ht+_t/et.locationSize*Ut)*lt,gt)}else{if(ft.isInstancedBufferAttribute){for(let at=0;at<et.locationSize;at++)d(et.location+at,ft.meshPerAttribute);x.isInstancedMesh!==!0&&O._maxInstanceCount===void 0&&(O._maxInstanceCount=ft.meshPerAttribute*ft.count)}else for(let at=0;at<et.locationSize;at++)m(et.location+at);i.bindBuffer(i.ARRAY_BUFFER,mt);for(let at=0;at<et.locationSize;at++)E(et.location+at,_t/et.locationSize,st,ht,_t*lt,_t/et.locationSize*at*lt,gt)}}else if(J!==void 0){const ht=J[K];if(ht!==void 0)switch(ht.length){case 2:i.vertexAttrib2fv(et.location,ht);break;case 3:i.vertexAttrib3fv(et.location,ht);break;case 4:i.vertexAttrib4fv(et.location,ht);break;default:i.vertexAttrib1fv(et.location,ht)}}}}S()}function U(){F();for(const x in n){const R=n[x];for(const G in R){const O=R[G];for(const $ in O)h(O[$].object),delete O[$];delete R[G]}delete n[x]}}function P(x){if(n[x.id]===void 0)return;const R=n[x.id];for(const G in R){const O=R[G];for(const $ in O)h(O[$].object),delete O[$];delete R[G]}delete n[x.id]}function I(x){for(const R in n){const G=n[R];if(G[x.id]===void 0)continue;const O=G[x.id];for(const $ in O)h(O[$].object),delete O[$];delete G[x.id]}}function F(){w(),o=!0,r!==s&&(r=s,c(r.object))}function w(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:F,resetDefaultState:w,dispose:U,releaseStatesOfGeometry:P,releaseStatesOfProgram:I,initAttributes:b,enableAttribute:m,disableUnusedAttributes:S}}function ly(i,t,e){let n;function s(c){n=c}function r(c,h){i.drawArrays(n,c,h),e.update(h,n,1)}function o(c,h,u){u!==0&&(i.drawArraysInstanced(n,c,h,u),e.update(h,n,u))}function a(c,h,u){if(u===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,c,0,h,0,u);let p=0;for(let _=0;_<u;_++)p+=h[_];e.update(p,n,1)}function l(c,h,u,f){if(u===0)return;const p=t.get("WEBGL_multi_draw");if(p===null)for(let _=0;_<c.length;_++)o(c[_],h[_],f[_]);else{p.multiDrawArraysInstancedWEBGL(n,c,0,h,0,f,0,u);let _=0;for(let b=0;b<u;b++)_+=h[b]*f[b];e.update(_,n,1)}}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a,this.renderMultiDrawInstances=l}function cy(i,t,e,n){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){const I=t.get("EXT_texture_filter_anisotropic");s=i.getParameter(I.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(I){return!(I!==wi&&n.convert(I)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(I){const F=I===ta&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(I!==ls&&n.convert(I)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE)&&I!==yi&&!F)}function l(I){if(I==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";I="mediump"}return I==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp";const h=l(c);h!==c&&(console.warn("THREE.WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);const u=e.logarithmicDepthBuffer===!0,f=e.reverseDepthBuffer===!0&&t.has("EXT_clip_control"),p=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),_=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),b=i.getParameter(i.MAX_TEXTURE_SIZE),m=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),d=i.getParameter(i.MAX_VERTEX_ATTRIBS),S=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),E=i.getParameter(i.MAX_VARYING_VECTORS),v=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),U=_>0,P=i.getParameter(i.MAX_SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:u,reverseDepthBuffer:f,maxTextures:p,maxVertexTextures:_,maxTextureSize:b,maxCubemapSize:m,maxAttributes:d,maxVertexUniforms:S,maxVaryings:E,maxFragmentUniforms:v,vertexTextures:U,maxSamples:P}}function hy(i){const t=this;let e=null,n=0,s=!1,r=!1;const o=new es,a=new te,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,f){const p=u.length!==0||f||n!==0||s;return s=f,n=u.length,p},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,f){e=h(u,f,0)},this.setState=function(u,f,p){const _=u.clippingPlanes,b=u.clipIntersection,m=u.clipShadows,d=i.get(u);if(!s||_===null||_.length===0||r&&!m)r?h(null):c();else{const S=r?0:n,E=S*4;let v=d.clippingState||null;l.value=v,v=h(_,f,E,p);for(let U=0;U!==E;++U)v[U]=e[U];d.clippingState=v,this.numIntersection=b?this.numPlanes:0,this.numPlanes+=S}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=n>0),t.numPlanes=n,t.numIntersection=0}function h(u,f,p,_){const b=u!==null?u.length:0;let m=null;if(b!==0){if(m=l.value,_!==!0||m===null){const d=p+b*4,S=f.matrixWorldInverse;a.getNormalMatrix(S),(m===null||m.length<d)&&(m=new Float32Array(d));for(let E=0,v=p;E!==b;++E,v+=4)o.copy(u[E]).applyMatrix4(S,a),o.normal.toArray(m,v),m[v+3]=o.constant}l.value=m,l.needsUpdate=!0}return t.numPlanes=b,t.numIntersection=0,m}}function uy(i){let t=new WeakMap;function e(o,a){return a===wh?o.mapping=ho:a===Eh&&(o.mapping=uo),o}function n(o){if(o&&o.isTexture){const a=o.mapping;if(a===wh||a===Eh)if(t.has(o)){const l=t.get(o).texture;return e(l,o.mapping)}else{const l=o.image;if(l&&l.height>0){const c=new Sx(l.height);return c.fromEquirectangularTexture(i,o),t.set(o,c),o.addEventListener("dispose",s),e(c.texture,o.mapping)}else return null}}return o}function s(o){const a=o.target;a.removeEventListener("dispose",s);const l=t.get(a);l!==void 0&&(t.delete(a),l.dispose())}function r(){t=new WeakMap}return{get:n,dispose:r}}class i_ extends Iu{constructor(t=-1,e=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){const t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2;let r=n-t,o=n+t,a=s+e,l=s-e;if(this.view!==null&&this.view.enabled){const c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){const e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}}const Kr=4,Fd=[.125,.215,.35,.446,.526,.582],sr=20,Fc=new i_,Dd=new ie;let Dc=null,Uc=0,Nc=0,Oc=!1;const $s=(1+Math.sqrt(5))/2,Hr=1/$s,Ud=[new D(-$s,Hr,0),new D($s,Hr,0),new D(-Hr,0,$s),new D(Hr,0,$s),new D(0,$s,-Hr),new D(0,$s,Hr),new D(-1,1,-1),new D(1,1,-1),new D(-1,1,1),new D(1,1,1)];class Nd{constructor(t){this._renderer=t,this._pingPongRenderTarget=null,this._lodMax=0,this._cubeSize=0,this._lodPlanes=[],this._sizeLods=[],this._sigmas=[],this._blurMaterial=null,this._cubemapMaterial=null,this._equirectMaterial=null,this._compileMaterial(this._blurMaterial)}fromScene(t,e=0,n=.1,s=100){Dc=this._renderer.getRenderTarget(),Uc=this._renderer.getActiveCubeFace(),Nc=this._renderer.getActiveMipmapLevel(),Oc=this._renderer.xr.enabled,this._renderer.xr.enabled=!1,this._setSize(256);const r=this._allocateTargets();return r.depthBuffer=!0,this._sceneToCubeUV(t,n,s,r),e>0&&this._blur(r,0,0,e),this._applyPMREM(r),this._cleanup(r),r}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=Bd(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=kd(),this._compileMaterial(this._equirectMaterial))}dispose(){this._dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose()}_setSize(t){this._lodMax=Math.floor(Math.log2(t)),this._cubeSize=Math.pow(2,this._lodMax)}_dispose(){this._blurMaterial!==null&&this._blurMaterial.dispose(),this._pingPongRenderTarget!==null&&this._pingPongRenderTarget.dispose();for(let t=0;t<this._lodPlanes.length;t++)this._lodPlanes[t].dispose()}_cleanup(t){this._renderer.setRenderTarget(Dc,Uc,Nc),this._renderer.xr.enabled=Oc,t.scissorTest=!1,Da(t,0,0,t.width,t.height)}_fromTexture(t,e){t.mapping===ho||t.mapping===uo?this._setSize(t.image.length===0?16:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4),Dc=this._renderer.getRenderTarget(),Uc=this._renderer.getActiveCubeFace(),Nc=this._renderer.getActiveMipmapLevel(),Oc=this._renderer.xr.enabled,this._renderer.xr.enabled=!1;const n=e||this._allocateTargets();return this._textureToCubeUV(t,n),this._applyPMREM(n),this._cleanup(n),n}_allocateTargets(){const t=3*Math.max(this._cubeSize,112),e=4*this._cubeSize,n={magFilter:Bi,minFilter:Bi,generateMipmaps:!1,type:ta,format:wi,colorSpace:pr,depthBuffer:!1},s=Od(t,e,n);if(this._pingPongRenderTarget===null||this._pingPongRenderTarget.width!==t||this._pingPongRenderTarget.height!==e){this._pingPongRenderTarget!==null&&this._dispose(),this._pingPongRenderTarget=Od(t,e,n);const{_lodMax:r}=this;({sizeLods:this._sizeLods,lodPlanes:this._lodPlanes,sigmas:this._sigmas}=fy(r)),this._blurMaterial=dy(r,t,e)}return s}_compileMaterial(t){const e=new an(this._lodPlanes[0],t);this._renderer.compile(e,Fc)}_sceneToCubeUV(t,e,n,s){const a=new ci(90,1,e,n),l=[1,-1,1,1,1,1],c=[1,1,1,-1,-1,-1],h=this._renderer,u=h.autoClear,f=h.toneMapping;h.getClearColor(Dd),h.toneMapping=As,h.autoClear=!1;const p=new Km({name:"PMREM.Background",side:Gn,depthWrite:!1,depthTest:!1}),_=new an(new xo,p);let b=!1;const m=t.background;m?m.isColor&&(p.color.copy(m),t.background=null,b=!0):(p.color.copy(Dd),b=!0);for(let d=0;d<6;d++){const S=d%3;S===0?(a.up.set(0,l[d],0),a.lookAt(c[d],0,0)):S===1?(a.up.set(0,0,l[d]),a.lookAt(0,c[d],0)):(a.up.set(0,l[d],0),a.lookAt(0,0,c[d]));const E=this._cubeSize;Da(s,S*E,d>2?E:0,E,E),h.setRenderTarget(s),b&&h.render(_,a),h.render(t,a)}_.geometry.dispose(),_.material.dispose(),h.toneMapping=f,h.autoClear=u,t.background=m}_textureToCubeUV(t,e){const n=this._renderer,s=t.mapping===ho||t.mapping===uo;s?(this._cubemapMaterial===null&&(this._cubemapMaterial=Bd()),this._cubemapMaterial.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):this._equirectMaterial===null&&(this._equirectMaterial=kd());const r=s?this._cubemapMaterial:this._equirectMaterial,o=new an(this._lodPlanes[0],r),a=r.uniforms;a.envMap.value=t;const l=this._cubeSize;Da(e,0,0,3*l,2*l),n.setRenderTarget(e),n.render(o,Fc)}_applyPMREM(t){const e=this._renderer,n=e.autoClear;e.autoClear=!1;const s=this._lodPlanes.length;for(let r=1;r<s;r++){const o=Math.sqrt(this._sigmas[r]*this._sigmas[r]-this._sigmas[r-1]*this._sigmas[r-1]),a=Ud[(s-r-1)%Ud.length];this._blur(t,r-1,r,o,a)}e.autoClear=n}_blur(t,e,n,s,r){const o=this._pingPongRenderTarget;this._halfBlur(t,o,e,n,s,"latitudinal",r),this._halfBlur(o,t,n,n,s,"longitudinal",r)}_halfBlur(t,e,n,s,r,o,a){const l=this._renderer,c=this._blurMaterial;o!=="latitudinal"&&o!=="longitudinal"&&console.error("blur direction must be either latitudinal or longitudinal!");const h=3,u=new an(this._lodPlanes[s],c),f=c.uniforms,p=this._sizeLods[n]-1,_=isFinite(r)?Math.PI/(2*p):2*Math.PI/(2*sr-1),b=r/_,m=isFinite(r)?1+Math.floor(h*b):sr;m>sr&&console.warn(`sigmaRadians, ${r}, is too large and will clip, as it requested ${m} samples when the maximum is set to ${sr}`);const d=[];let S=0;for(let I=0;I<sr;++I){const F=I/b,w=Math.exp(-F*F/2);d.push(w),I===0?S+=w:I<m&&(S+=2*w)}for(let I=0;I<d.length;I++)d[I]=d[I]/S;f.envMap.value=t.texture,f.samples.value=m,f.weights.value=d,f.latitudinal.value=o==="latitudinal",a&&(f.poleAxis.value=a);const{_lodMax:E}=this;f.dTheta.value=_,f.mipInt.value=E-n;const v=this._sizeLods[s],U=3*v*(s>E-Kr?s-E+Kr:0),P=4*(this._cubeSize-v);Da(e,U,P,3*v,2*v),l.setRenderTarget(e),l.render(u,Fc)}}function fy(i){const t=[],e=[],n=[];let s=i;const r=i-Kr+1+Fd.length;for(let o=0;o<r;o++){const a=Math.pow(2,s);e.push(a);let l=1/a;o>i-Kr?l=Fd[o-i+Kr-1]:o===0&&(l=0),n.push(l);const c=1/(a-2),h=-c,u=1+c,f=[h,h,u,h,u,u,h,h,u,u,h,u],p=6,_=6,b=3,m=2,d=1,S=new Float32Array(b*_*p),E=new Float32Array(m*_*p),v=new Float32Array(d*_*p);for(let P=0;P<p;P++){const I=P%3*2/3-1,F=P>2?0:-1,w=[I,F,0,I+2/3,F,0,I+2/3,F+1,0,I,F,0,I+2/3,F+1,0,I,F+1,0];S.set(w,b*_*P),E.set(f,m*_*P);const x=[P,P,P,P,P,P];v.set(x,d*_*P)}const U=new xn;U.setAttribute("position",new We(S,b)),U.setAttribute("uv",new We(E,m)),U.setAttribute("faceIndex",new We(v,d)),t.push(U),s>Kr&&s--}return{lodPlanes:t,sizeLods:e,sigmas:n}}function Od(i,t,e){const n=new Cs(i,t,e);return n.texture.mapping=Ul,n.texture.name="PMREM.cubeUv",n.scissorTest=!0,n}function Da(i,t,e,n,s){i.viewport.set(t,e,n,s),i.scissor.set(t,e,n,s)}function dy(i,t,e){const n=new Float32Array(sr),s=new D(0,1,0);return new cs({name:"SphericalGaussianBlur",defines:{n:sr,CUBEUV_TEXEL_WIDTH:1/t,CUBEUV_TEXEL_HEIGHT:1/e,CUBEUV_MAX_MIP:`${i}.0`},uniforms:{envMap:{value:null},samples:{value:1},weights:{value:n},latitudinal:{value:!1},dTheta:{value:0},mipInt:{value:0},poleAxis:{value:s}},vertexShader:Du(),fragmentShader:`

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
		`,blending:rs,depthTest:!1,depthWrite:!1})}function kd(){return new cs({name:"EquirectangularToCubeUV",uniforms:{envMap:{value:null}},vertexShader:Du(),fragmentShader:`

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
		`,blending:rs,depthTest:!1,depthWrite:!1})}function Bd(){return new cs({name:"CubemapToCubeUV",uniforms:{envMap:{value:null},flipEnvMap:{value:-1}},vertexShader:Du(),fragmentShader:`

			precision mediump float;
			precision mediump int;

			uniform float flipEnvMap;

			varying vec3 vOutputDirection;

			uniform samplerCube envMap;

			void main() {

				gl_FragColor = textureCube( envMap, vec3( flipEnvMap * vOutputDirection.x, vOutputDirection.yz ) );

			}
		`,blending:rs,depthTest:!1,depthWrite:!1})}function Du(){return`

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
	`}function py(i){let t=new WeakMap,e=null;function n(a){if(a&&a.isTexture){const l=a.mapping,c=l===wh||l===Eh,h=l===ho||l===uo;if(c||h){let u=t.get(a);const f=u!==void 0?u.texture.pmremVersion:0;if(a.isRenderTargetTexture&&a.pmremVersion!==f)return e===null&&(e=new Nd(i)),u=c?e.fromEquirectangular(a,u):e.fromCubemap(a,u),u.texture.pmremVersion=a.pmremVersion,t.set(a,u),u.texture;if(u!==void 0)return u.texture;{const p=a.image;return c&&p&&p.height>0||h&&p&&s(p)?(e===null&&(e=new Nd(i)),u=c?e.fromEquirectangular(a):e.fromCubemap(a),u.texture.pmremVersion=a.pmremVersion,t.set(a,u),a.addEventListener("dispose",r),u.texture):null}}}return a}function s(a){let l=0;const c=6;for(let h=0;h<c;h++)a[h]!==void 0&&l++;return l===c}function r(a){const l=a.target;l.removeEventListener("dispose",r);const c=t.get(l);c!==void 0&&(t.delete(l),c.dispose())}function o(){t=new WeakMap,e!==null&&(e.dispose(),e=null)}return{get:n,dispose:o}}function my(i){const t={};function e(n){if(t[n]!==void 0)return t[n];let s;switch(n){case"WEBGL_depth_texture":s=i.getExtension("WEBGL_depth_texture")||i.getExtension("MOZ_WEBGL_depth_texture")||i.getExtension("WEBKIT_WEBGL_depth_texture");break;case"EXT_texture_filter_anisotropic":s=i.getExtension("EXT_texture_filter_anisotropic")||i.getExtension("MOZ_EXT_texture_filter_anisotropic")||i.getExtension("WEBKIT_EXT_texture_filter_anisotropic");break;case"WEBGL_compressed_texture_s3tc":s=i.getExtension("WEBGL_compressed_texture_s3tc")||i.getExtension("MOZ_WEBGL_compressed_texture_s3tc")||i.getExtension("WEBKIT_WEBGL_compressed_texture_s3tc");break;case"WEBGL_compressed_texture_pvrtc":s=i.getExtension("WEBGL_compressed_texture_pvrtc")||i.getExtension("WEBKIT_WEBGL_compressed_texture_pvrtc");break;default:s=i.getExtension(n)}return t[n]=s,s}return{has:function(n){return e(n)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(n){const s=e(n);return s===null&&Ho("THREE.WebGLRenderer: "+n+" extension not supported."),s}}}function _y(i,t,e,n){const s={},r=new WeakMap;function o(u){const f=u.target;f.index!==null&&t.remove(f.index);for(const _ in f.attributes)t.remove(f.attributes[_]);for(const _ in f.morphAttributes){const b=f.morphAttributes[_];for(let m=0,d=b.length;m<d;m++)t.remove(b[m])}f.removeEventListener("dispose",o),delete s[f.id];const p=r.get(f);p&&(t.remove(p),r.delete(f)),n.releaseStatesOfGeometry(f),f.isInstancedBufferGeometry===!0&&delete f._maxInstanceCount,e.memory.geometries--}function a(u,f){return s[f.id]===!0||(f.addEventListener("dispose",o),s[f.id]=!0,e.memory.geometries++),f}function l(u){const f=u.attributes;for(const _ in f)t.update(f[_],i.ARRAY_BUFFER);const p=u.morphAttributes;for(const _ in p){const b=p[_];for(let m=0,d=b.length;m<d;m++)t.update(b[m],i.ARRAY_BUFFER)}}function c(u){const f=[],p=u.index,_=u.attributes.position;let b=0;if(p!==null){const S=p.array;b=p.version;for(let E=0,v=S.length;E<v;E+=3){const U=S[E+0],P=S[E+1],I=S[E+2];f.push(U,P,P,I,I,U)}}else if(_!==void 0){const S=_.array;b=_.version;for(let E=0,v=S.length/3-1;E<v;E+=3){const U=E+0,P=E+1,I=E+2;f.push(U,P,P,I,I,U)}}else return;const m=new(Ym(f)?Qm:Jm)(f,1);m.version=b;const d=r.get(u);d&&t.remove(d),r.set(u,m)}function h(u){const f=r.get(u);if(f){const p=u.index;p!==null&&f.version<p.version&&c(u)}else c(u);return r.get(u)}return{get:a,update:l,getWireframeAttribute:h}}function gy(i,t,e){let n;function s(f){n=f}let r,o;function a(f){r=f.type,o=f.bytesPerElement}function l(f,p){i.drawElements(n,p,r,f*o),e.update(p,n,1)}function c(f,p,_){_!==0&&(i.drawElementsInstanced(n,p,r,f*o,_),e.update(p,n,_))}function h(f,p,_){if(_===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,p,0,r,f,0,_);let m=0;for(let d=0;d<_;d++)m+=p[d];e.update(m,n,1)}function u(f,p,_,b){if(_===0)return;const m=t.get("WEBGL_multi_draw");if(m===null)for(let d=0;d<f.length;d++)c(f[d]/o,p[d],b[d]);else{m.multiDrawElementsInstancedWEBGL(n,p,0,r,f,0,b,0,_);let d=0;for(let S=0;S<_;S++)d+=p[S]*b[S];e.update(d,n,1)}}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h,this.renderMultiDrawInstances=u}function by(i){const t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(e.calls++,o){case i.TRIANGLES:e.triangles+=a*(r/3);break;case i.LINES:e.lines+=a*(r/2);break;case i.LINE_STRIP:e.lines+=a*(r-1);break;case i.LINE_LOOP:e.lines+=a*r;break;case i.POINTS:e.points+=a*r;break;default:console.error("THREE.WebGLInfo: Unknown draw mode:",o);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:n}}function vy(i,t,e){const n=new WeakMap,s=new ze;function r(o,a,l){const c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0;let f=n.get(a);if(f===void 0||f.count!==u){let x=function(){F.dispose(),n.delete(a),a.removeEventListener("dispose",x)};var p=x;f!==void 0&&f.texture.dispose();const _=a.morphAttributes.position!==void 0,b=a.morphAttributes.normal!==void 0,m=a.morphAttributes.color!==void 0,d=a.morphAttributes.position||[],S=a.morphAttributes.normal||[],E=a.morphAttributes.color||[];let v=0;_===!0&&(v=1),b===!0&&(v=2),m===!0&&(v=3);let U=a.attributes.position.count*v,P=1;U>t.maxTextureSize&&(P=Math.ceil(U/t.maxTextureSize),U=t.maxTextureSize);const I=new Float32Array(U*P*4*u),F=new jm(I,U,P,u);F.type=yi,F.needsUpdate=!0;const w=v*4;for(let R=0;R<u;R++){const G=d[R],O=S[R],$=E[R],Y=U*P*4*R;for(let J=0;J<G.count;J++){const K=J*w;_===!0&&(s.fromBufferAttribute(G,J),I[Y+K+0]=s.x,I[Y+K+1]=s.y,I[Y+K+2]=s.z,I[Y+K+3]=0),b===!0&&(s.fromBufferAttribute(O,J),I[Y+K+4]=s.x,I[Y+K+5]=s.y,I[Y+K+6]=s.z,I[Y+K+7]=0),m===!0&&(s.fromBufferAttribute($,J),I[Y+K+8]=s.x,I[Y+K+9]=s.y,I[Y+K+10]=s.z,I[Y+K+11]=$.itemSize===4?s.w:1)}}f={count:u,texture:F,size:new qt(U,P)},n.set(a,f),a.addEventListener("dispose",x)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,e);else{let _=0;for(let m=0;m<c.length;m++)_+=c[m];const b=a.morphTargetsRelative?1:1-_;l.getUniforms().setValue(i,"morphTargetBaseInfluence",b),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",f.texture,e),l.getUniforms().setValue(i,"morphTargetsTextureSize",f.size)}return{update:r}}function xy(i,t,e,n){let s=new WeakMap;function r(l){const c=n.render.frame,h=l.geometry,u=t.get(l,h);if(s.get(u)!==c&&(t.update(u),s.set(u,c)),l.isInstancedMesh&&(l.hasEventListener("dispose",a)===!1&&l.addEventListener("dispose",a),s.get(l)!==c&&(e.update(l.instanceMatrix,i.ARRAY_BUFFER),l.instanceColor!==null&&e.update(l.instanceColor,i.ARRAY_BUFFER),s.set(l,c))),l.isSkinnedMesh){const f=l.skeleton;s.get(f)!==c&&(f.update(),s.set(f,c))}return u}function o(){s=new WeakMap}function a(l){const c=l.target;c.removeEventListener("dispose",a),e.remove(c.instanceMatrix),c.instanceColor!==null&&e.remove(c.instanceColor)}return{update:r,dispose:o}}class s_ extends kn{constructor(t,e,n,s,r,o,a,l,c,h=eo){if(h!==eo&&h!==po)throw new Error("DepthTexture format must be either THREE.DepthFormat or THREE.DepthStencilFormat");n===void 0&&h===eo&&(n=ur),n===void 0&&h===po&&(n=fo),super(null,s,r,o,a,l,h,n,c),this.isDepthTexture=!0,this.image={width:t,height:e},this.magFilter=a!==void 0?a:Cn,this.minFilter=l!==void 0?l:Cn,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.compareFunction=t.compareFunction,this}toJSON(t){const e=super.toJSON(t);return this.compareFunction!==null&&(e.compareFunction=this.compareFunction),e}}const r_=new kn,zd=new s_(1,1),o_=new jm,a_=new ox,l_=new e_,Vd=[],Hd=[],Gd=new Float32Array(16),Wd=new Float32Array(9),Xd=new Float32Array(4);function Mo(i,t,e){const n=i[0];if(n<=0||n>0)return i;const s=t*e;let r=Vd[s];if(r===void 0&&(r=new Float32Array(s),Vd[s]=r),t!==0){n.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,i[o].toArray(r,a)}return r}function cn(i,t){if(i.length!==t.length)return!1;for(let e=0,n=i.length;e<n;e++)if(i[e]!==t[e])return!1;return!0}function hn(i,t){for(let e=0,n=t.length;e<n;e++)i[e]=t[e]}function Vl(i,t){let e=Hd[t];e===void 0&&(e=new Int32Array(t),Hd[t]=e);for(let n=0;n!==t;++n)e[n]=i.allocateTextureUnit();return e}function My(i,t){const e=this.cache;e[0]!==t&&(i.uniform1f(this.addr,t),e[0]=t)}function Sy(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(cn(e,t))return;i.uniform2fv(this.addr,t),hn(e,t)}}function yy(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(i.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(cn(e,t))return;i.uniform3fv(this.addr,t),hn(e,t)}}function wy(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(cn(e,t))return;i.uniform4fv(this.addr,t),hn(e,t)}}function Ey(i,t){const e=this.cache,n=t.elements;if(n===void 0){if(cn(e,t))return;i.uniformMatrix2fv(this.addr,!1,t),hn(e,t)}else{if(cn(e,n))return;Xd.set(n),i.uniformMatrix2fv(this.addr,!1,Xd),hn(e,n)}}function Ty(i,t){const e=this.cache,n=t.elements;if(n===void 0){if(cn(e,t))return;i.uniformMatrix3fv(this.addr,!1,t),hn(e,t)}else{if(cn(e,n))return;Wd.set(n),i.uniformMatrix3fv(this.addr,!1,Wd),hn(e,n)}}function Ay(i,t){const e=this.cache,n=t.elements;if(n===void 0){if(cn(e,t))return;i.uniformMatrix4fv(this.addr,!1,t),hn(e,t)}else{if(cn(e,n))return;Gd.set(n),i.uniformMatrix4fv(this.addr,!1,Gd),hn(e,n)}}function Ry(i,t){const e=this.cache;e[0]!==t&&(i.uniform1i(this.addr,t),e[0]=t)}function Py(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(cn(e,t))return;i.uniform2iv(this.addr,t),hn(e,t)}}function Cy(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(cn(e,t))return;i.uniform3iv(this.addr,t),hn(e,t)}}function Ly(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(cn(e,t))return;i.uniform4iv(this.addr,t),hn(e,t)}}function Iy(i,t){const e=this.cache;e[0]!==t&&(i.uniform1ui(this.addr,t),e[0]=t)}function Fy(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(cn(e,t))return;i.uniform2uiv(this.addr,t),hn(e,t)}}function Dy(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(cn(e,t))return;i.uniform3uiv(this.addr,t),hn(e,t)}}function Uy(i,t){const e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(cn(e,t))return;i.uniform4uiv(this.addr,t),hn(e,t)}}function Ny(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?(zd.compareFunction=Xm,r=zd):r=r_,e.setTexture2D(t||r,s)}function Oy(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture3D(t||a_,s)}function ky(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTextureCube(t||l_,s)}function By(i,t,e){const n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture2DArray(t||o_,s)}function zy(i){switch(i){case 5126:return My;case 35664:return Sy;case 35665:return yy;case 35666:return wy;case 35674:return Ey;case 35675:return Ty;case 35676:return Ay;case 5124:case 35670:return Ry;case 35667:case 35671:return Py;case 35668:case 35672:return Cy;case 35669:case 35673:return Ly;case 5125:return Iy;case 36294:return Fy;case 36295:return Dy;case 36296:return Uy;case 35678:case 36198:case 36298:case 36306:case 35682:return Ny;case 35679:case 36299:case 36307:return Oy;case 35680:case 36300:case 36308:case 36293:return ky;case 36289:case 36303:case 36311:case 36292:return By}}function Vy(i,t){i.uniform1fv(this.addr,t)}function Hy(i,t){const e=Mo(t,this.size,2);i.uniform2fv(this.addr,e)}function Gy(i,t){const e=Mo(t,this.size,3);i.uniform3fv(this.addr,e)}function Wy(i,t){const e=Mo(t,this.size,4);i.uniform4fv(this.addr,e)}function Xy(i,t){const e=Mo(t,this.size,4);i.uniformMatrix2fv(this.addr,!1,e)}function Yy(i,t){const e=Mo(t,this.size,9);i.uniformMatrix3fv(this.addr,!1,e)}function qy(i,t){const e=Mo(t,this.size,16);i.uniformMatrix4fv(this.addr,!1,e)}function jy(i,t){i.uniform1iv(this.addr,t)}function $y(i,t){i.uniform2iv(this.addr,t)}function Zy(i,t){i.uniform3iv(this.addr,t)}function Ky(i,t){i.uniform4iv(this.addr,t)}function Jy(i,t){i.uniform1uiv(this.addr,t)}function Qy(i,t){i.uniform2uiv(this.addr,t)}function tw(i,t){i.uniform3uiv(this.addr,t)}function ew(i,t){i.uniform4uiv(this.addr,t)}function nw(i,t,e){const n=this.cache,s=t.length,r=Vl(e,s);cn(n,r)||(i.uniform1iv(this.addr,r),hn(n,r));for(let o=0;o!==s;++o)e.setTexture2D(t[o]||r_,r[o])}function iw(i,t,e){const n=this.cache,s=t.length,r=Vl(e,s);cn(n,r)||(i.uniform1iv(this.addr,r),hn(n,r));for(let o=0;o!==s;++o)e.setTexture3D(t[o]||a_,r[o])}function sw(i,t,e){const n=this.cache,s=t.length,r=Vl(e,s);cn(n,r)||(i.uniform1iv(this.addr,r),hn(n,r));for(let o=0;o!==s;++o)e.setTextureCube(t[o]||l_,r[o])}function rw(i,t,e){const n=this.cache,s=t.length,r=Vl(e,s);cn(n,r)||(i.uniform1iv(this.addr,r),hn(n,r));for(let o=0;o!==s;++o)e.setTexture2DArray(t[o]||o_,r[o])}function ow(i){switch(i){case 5126:return Vy;case 35664:return Hy;case 35665:return Gy;case 35666:return Wy;case 35674:return Xy;case 35675:return Yy;case 35676:return qy;case 5124:case 35670:return jy;case 35667:case 35671:return $y;case 35668:case 35672:return Zy;case 35669:case 35673:return Ky;case 5125:return Jy;case 36294:return Qy;case 36295:return tw;case 36296:return ew;case 35678:case 36198:case 36298:case 36306:case 35682:return nw;case 35679:case 36299:case 36307:return iw;case 35680:case 36300:case 36308:case 36293:return sw;case 36289:case 36303:case 36311:case 36292:return rw}}class aw{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.setValue=zy(e.type)}}class lw{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=ow(e.type)}}class cw{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,n){const s=this.seq;for(let r=0,o=s.length;r!==o;++r){const a=s[r];a.setValue(t,e[a.id],n)}}}const kc=/(\w+)(\])?(\[|\.)?/g;function Yd(i,t){i.seq.push(t),i.map[t.id]=t}function hw(i,t,e){const n=i.name,s=n.length;for(kc.lastIndex=0;;){const r=kc.exec(n),o=kc.lastIndex;let a=r[1];const l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){Yd(e,c===void 0?new aw(a,i,t):new lw(a,i,t));break}else{let u=e.map[a];u===void 0&&(u=new cw(a),Yd(e,u)),e=u}}}class Qa{constructor(t,e){this.seq=[],this.map={};const n=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let s=0;s<n;++s){const r=t.getActiveUniform(e,s),o=t.getUniformLocation(e,r.name);hw(r,o,this)}}setValue(t,e,n,s){const r=this.map[e];r!==void 0&&r.setValue(t,n,s)}setOptional(t,e,n){const s=e[n];s!==void 0&&this.setValue(t,n,s)}static upload(t,e,n,s){for(let r=0,o=e.length;r!==o;++r){const a=e[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(t,l.value,s)}}static seqWithValue(t,e){const n=[];for(let s=0,r=t.length;s!==r;++s){const o=t[s];o.id in e&&n.push(o)}return n}}function qd(i,t,e){const n=i.createShader(t);return i.shaderSource(n,e),i.compileShader(n),n}const uw=37297;let fw=0;function dw(i,t){const e=i.split(`
`),n=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=s;o<r;o++){const a=o+1;n.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return n.join(`
`)}const jd=new te;function pw(i){ue._getMatrix(jd,ue.workingColorSpace,i);const t=`mat3( ${jd.elements.map(e=>e.toFixed(4))} )`;switch(ue.getTransfer(i)){case kl:return[t,"LinearTransferOETF"];case Te:return[t,"sRGBTransferOETF"];default:return console.warn("THREE.WebGLProgram: Unsupported color space: ",i),[t,"LinearTransferOETF"]}}function $d(i,t,e){const n=i.getShaderParameter(t,i.COMPILE_STATUS),s=i.getShaderInfoLog(t).trim();if(n&&s==="")return"";const r=/ERROR: 0:(\d+)/.exec(s);if(r){const o=parseInt(r[1]);return e.toUpperCase()+`

`+s+`

`+dw(i.getShaderSource(t),o)}else return s}function mw(i,t){const e=pw(t);return[`vec4 ${i}( vec4 value ) {`,`	return ${e[1]}( vec4( value.rgb * ${e[0]}, value.a ) );`,"}"].join(`
`)}function _w(i,t){let e;switch(t){case Iv:e="Linear";break;case Fv:e="Reinhard";break;case Dv:e="Cineon";break;case Uv:e="ACESFilmic";break;case Ov:e="AgX";break;case kv:e="Neutral";break;case Nv:e="Custom";break;default:console.warn("THREE.WebGLProgram: Unsupported toneMapping:",t),e="Linear"}return"vec3 "+i+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}const Ua=new D;function gw(){ue.getLuminanceCoefficients(Ua);const i=Ua.x.toFixed(4),t=Ua.y.toFixed(4),e=Ua.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function bw(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Go).join(`
`)}function vw(i){const t=[];for(const e in i){const n=i[e];n!==!1&&t.push("#define "+e+" "+n)}return t.join(`
`)}function xw(i,t){const e={},n=i.getProgramParameter(t,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){const r=i.getActiveAttrib(t,s),o=r.name;let a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:i.getAttribLocation(t,o),locationSize:a}}return e}function Go(i){return i!==""}function Zd(i,t){const e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return i.replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows)}function Kd(i,t){return i.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}const Mw=/^[ \t]*#include +<([\w\d./]+)>/gm;function eu(i){return i.replace(Mw,yw)}const Sw=new Map;function yw(i,t){let e=ne[t];if(e===void 0){const n=Sw.get(t);if(n!==void 0)e=ne[n],console.warn('THREE.WebGLRenderer: Shader chunk "%s" has been deprecated. Use "%s" instead.',t,n);else throw new Error("Can not resolve #include <"+t+">")}return eu(e)}const ww=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function Jd(i){return i.replace(ww,Ew)}function Ew(i,t,e,n){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function Qd(i){let t=`precision ${i.precision} float;
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
#define LOW_PRECISION`),t}function Tw(i){let t="SHADOWMAP_TYPE_BASIC";return i.shadowMapType===Um?t="SHADOWMAP_TYPE_PCF":i.shadowMapType===uv?t="SHADOWMAP_TYPE_PCF_SOFT":i.shadowMapType===$i&&(t="SHADOWMAP_TYPE_VSM"),t}function Aw(i){let t="ENVMAP_TYPE_CUBE";if(i.envMap)switch(i.envMapMode){case ho:case uo:t="ENVMAP_TYPE_CUBE";break;case Ul:t="ENVMAP_TYPE_CUBE_UV";break}return t}function Rw(i){let t="ENVMAP_MODE_REFLECTION";if(i.envMap)switch(i.envMapMode){case uo:t="ENVMAP_MODE_REFRACTION";break}return t}function Pw(i){let t="ENVMAP_BLENDING_NONE";if(i.envMap)switch(i.combine){case Dl:t="ENVMAP_BLENDING_MULTIPLY";break;case Cv:t="ENVMAP_BLENDING_MIX";break;case Lv:t="ENVMAP_BLENDING_ADD";break}return t}function Cw(i){const t=i.envMapCubeUVHeight;if(t===null)return null;const e=Math.log2(t)-2,n=1/t;return{texelWidth:1/(3*Math.max(Math.pow(2,e),112)),texelHeight:n,maxMip:e}}function Lw(i,t,e,n){const s=i.getContext(),r=e.defines;let o=e.vertexShader,a=e.fragmentShader;const l=Tw(e),c=Aw(e),h=Rw(e),u=Pw(e),f=Cw(e),p=bw(e),_=vw(r),b=s.createProgram();let m,d,S=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(m=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,_].filter(Go).join(`
`),m.length>0&&(m+=`
`),d=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,_].filter(Go).join(`
`),d.length>0&&(d+=`
`)):(m=[Qd(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,_,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGDEPTHBUF":"",e.reverseDepthBuffer?"#define USE_REVERSEDEPTHBUF":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Go).join(`
`),d=[Qd(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,_,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+h:"",e.envMap?"#define "+u:"",f?"#define CUBEUV_TEXEL_WIDTH "+f.texelWidth:"",f?"#define CUBEUV_TEXEL_HEIGHT "+f.texelHeight:"",f?"#define CUBEUV_MAX_MIP "+f.maxMip+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor||e.batchingColor?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGDEPTHBUF":"",e.reverseDepthBuffer?"#define USE_REVERSEDEPTHBUF":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==As?"#define TONE_MAPPING":"",e.toneMapping!==As?ne.tonemapping_pars_fragment:"",e.toneMapping!==As?_w("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",ne.colorspace_pars_fragment,mw("linearToOutputTexel",e.outputColorSpace),gw(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(Go).join(`
`)),o=eu(o),o=Zd(o,e),o=Kd(o,e),a=eu(a),a=Zd(a,e),a=Kd(a,e),o=Jd(o),a=Jd(a),e.isRawShaderMaterial!==!0&&(S=`#version 300 es
`,m=[p,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+m,d=["#define varying in",e.glslVersion===Jo?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===Jo?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+d);const E=S+m+o,v=S+d+a,U=qd(s,s.VERTEX_SHADER,E),P=qd(s,s.FRAGMENT_SHADER,v);s.attachShader(b,U),s.attachShader(b,P),e.index0AttributeName!==void 0?s.bindAttribLocation(b,0,e.index0AttributeName):e.morphTargets===!0&&s.bindAttribLocation(b,0,"position"),s.linkProgram(b);function I(R){if(i.debug.checkShaderErrors){const G=s.getProgramInfoLog(b).trim(),O=s.getShaderInfoLog(U).trim(),$=s.getShaderInfoLog(P).trim();let Y=!0,J=!0;if(s.getProgramParameter(b,s.LINK_STATUS)===!1)if(Y=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,b,U,P);else{const K=$d(s,U,"vertex"),et=$d(s,P,"fragment");console.error("THREE.WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(b,s.VALIDATE_STATUS)+`

Material Name: `+R.name+`
Material Type: `+R.type+`

Program Info Log: `+G+`
`+K+`
`+et)}else G!==""?console.warn("THREE.WebGLProgram: Program Info Log:",G):(O===""||$==="")&&(J=!1);J&&(R.diagnostics={runnable:Y,programLog:G,vertexShader:{log:O,prefix:m},fragmentShader:{log:$,prefix:d}})}s.deleteShader(U),s.deleteShader(P),F=new Qa(s,b),w=xw(s,b)}let F;this.getUniforms=function(){return F===void 0&&I(this),F};let w;this.getAttributes=function(){return w===void 0&&I(this),w};let x=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return x===!1&&(x=s.getProgramParameter(b,uw)),x},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(b),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=fw++,this.cacheKey=t,this.usedTimes=1,this.program=b,this.vertexShader=U,this.fragmentShader=P,this}let Iw=0;class Fw{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t){const e=t.vertexShader,n=t.fragmentShader,s=this._getShaderStage(e),r=this._getShaderStage(n),o=this._getShaderCacheForMaterial(t);return o.has(s)===!1&&(o.add(s),s.usedTimes++),o.has(r)===!1&&(o.add(r),r.usedTimes++),this}remove(t){const e=this.materialCache.get(t);for(const n of e)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(t),this}getVertexShaderID(t){return this._getShaderStage(t.vertexShader).id}getFragmentShaderID(t){return this._getShaderStage(t.fragmentShader).id}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){const e=this.materialCache;let n=e.get(t);return n===void 0&&(n=new Set,e.set(t,n)),n}_getShaderStage(t){const e=this.shaderCache;let n=e.get(t);return n===void 0&&(n=new Dw(t),e.set(t,n)),n}}class Dw{constructor(t){this.id=Iw++,this.code=t,this.usedTimes=0}}function Uw(i,t,e,n,s,r,o){const a=new $m,l=new Fw,c=new Set,h=[],u=s.logarithmicDepthBuffer,f=s.vertexTextures;let p=s.precision;const _={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distanceRGBA",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function b(w){return c.add(w),w===0?"uv":`uv${w}`}function m(w,x,R,G,O){const $=G.fog,Y=O.geometry,J=w.isMeshStandardMaterial?G.environment:null,K=(w.isMeshStandardMaterial?e:t).get(w.envMap||J),et=K&&K.mapping===Ul?K.image.height:null,ft=_[w.type];w.precision!==null&&(p=s.getMaxPrecision(w.precision),p!==w.precision&&console.warn("THREE.WebGLProgram.getParameters:",w.precision,"not supported, using",p,"instead."));const ht=Y.morphAttributes.position||Y.morphAttributes.normal||Y.morphAttributes.color,_t=ht!==void 0?ht.length:0;let Mt=0;Y.morphAttributes.position!==void 0&&(Mt=1),Y.morphAttributes.normal!==void 0&&(Mt=2),Y.morphAttributes.color!==void 0&&(Mt=3);let mt,st,lt,gt;if(ft){const ge=Oi[ft];mt=ge.vertexShader,st=ge.fragmentShader}else mt=w.vertexShader,st=w.fragmentShader,l.update(w),lt=l.getVertexShaderID(w),gt=l.getFragmentShaderID(w);const at=i.getRenderTarget(),zt=i.state.buffers.depth.getReversed(),Ht=O.isInstancedMesh===!0,Ut=O.isBatchedMesh===!0,le=!!w.map,Kt=!!w.matcap,ce=!!K,V=!!w.aoMap,tn=!!w.lightMap,Qt=!!w.bumpMap,ee=!!w.normalMap,Gt=!!w.displacementMap,fe=!!w.emissiveMap,Lt=!!w.metalnessMap,C=!!w.roughnessMap,y=w.anisotropy>0,Z=w.clearcoat>0,Q=w.dispersion>0,W=w.iridescence>0,nt=w.sheen>0,St=w.transmission>0,bt=y&&!!w.anisotropyMap,Tt=Z&&!!w.clearcoatMap,Zt=Z&&!!w.clearcoatNormalMap,dt=Z&&!!w.clearcoatRoughnessMap,vt=W&&!!w.iridescenceMap,Nt=W&&!!w.iridescenceThicknessMap,kt=nt&&!!w.sheenColorMap,wt=nt&&!!w.sheenRoughnessMap,se=!!w.specularMap,jt=!!w.specularColorMap,de=!!w.specularIntensityMap,z=St&&!!w.transmissionMap,xt=St&&!!w.thicknessMap,it=!!w.gradientMap,ot=!!w.alphaMap,At=w.alphaTest>0,Rt=!!w.alphaHash,Jt=!!w.extensions;let Oe=As;w.toneMapped&&(at===null||at.isXRRenderTarget===!0)&&(Oe=i.toneMapping);const fn={shaderID:ft,shaderType:w.type,shaderName:w.name,vertexShader:mt,fragmentShader:st,defines:w.defines,customVertexShaderID:lt,customFragmentShaderID:gt,isRawShaderMaterial:w.isRawShaderMaterial===!0,glslVersion:w.glslVersion,precision:p,batching:Ut,batchingColor:Ut&&O._colorsTexture!==null,instancing:Ht,instancingColor:Ht&&O.instanceColor!==null,instancingMorph:Ht&&O.morphTexture!==null,supportsVertexTextures:f,outputColorSpace:at===null?i.outputColorSpace:at.isXRRenderTarget===!0?at.texture.colorSpace:pr,alphaToCoverage:!!w.alphaToCoverage,map:le,matcap:Kt,envMap:ce,envMapMode:ce&&K.mapping,envMapCubeUVHeight:et,aoMap:V,lightMap:tn,bumpMap:Qt,normalMap:ee,displacementMap:f&&Gt,emissiveMap:fe,normalMapObjectSpace:ee&&w.normalMapType===Hv,normalMapTangentSpace:ee&&w.normalMapType===Lu,metalnessMap:Lt,roughnessMap:C,anisotropy:y,anisotropyMap:bt,clearcoat:Z,clearcoatMap:Tt,clearcoatNormalMap:Zt,clearcoatRoughnessMap:dt,dispersion:Q,iridescence:W,iridescenceMap:vt,iridescenceThicknessMap:Nt,sheen:nt,sheenColorMap:kt,sheenRoughnessMap:wt,specularMap:se,specularColorMap:jt,specularIntensityMap:de,transmission:St,transmissionMap:z,thicknessMap:xt,gradientMap:it,opaque:w.transparent===!1&&w.blending===to&&w.alphaToCoverage===!1,alphaMap:ot,alphaTest:At,alphaHash:Rt,combine:w.combine,mapUv:le&&b(w.map.channel),aoMapUv:V&&b(w.aoMap.channel),lightMapUv:tn&&b(w.lightMap.channel),bumpMapUv:Qt&&b(w.bumpMap.channel),normalMapUv:ee&&b(w.normalMap.channel),displacementMapUv:Gt&&b(w.displacementMap.channel),emissiveMapUv:fe&&b(w.emissiveMap.channel),metalnessMapUv:Lt&&b(w.metalnessMap.channel),roughnessMapUv:C&&b(w.roughnessMap.channel),anisotropyMapUv:bt&&b(w.anisotropyMap.channel),clearcoatMapUv:Tt&&b(w.clearcoatMap.channel),clearcoatNormalMapUv:Zt&&b(w.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:dt&&b(w.clearcoatRoughnessMap.channel),iridescenceMapUv:vt&&b(w.iridescenceMap.channel),iridescenceThicknessMapUv:Nt&&b(w.iridescenceThicknessMap.channel),sheenColorMapUv:kt&&b(w.sheenColorMap.channel),sheenRoughnessMapUv:wt&&b(w.sheenRoughnessMap.channel),specularMapUv:se&&b(w.specularMap.channel),specularColorMapUv:jt&&b(w.specularColorMap.channel),specularIntensityMapUv:de&&b(w.specularIntensityMap.channel),transmissionMapUv:z&&b(w.transmissionMap.channel),thicknessMapUv:xt&&b(w.thicknessMap.channel),alphaMapUv:ot&&b(w.alphaMap.channel),vertexTangents:!!Y.attributes.tangent&&(ee||y),vertexColors:w.vertexColors,vertexAlphas:w.vertexColors===!0&&!!Y.attributes.color&&Y.attributes.color.itemSize===4,pointsUvs:O.isPoints===!0&&!!Y.attributes.uv&&(le||ot),fog:!!$,useFog:w.fog===!0,fogExp2:!!$&&$.isFogExp2,flatShading:w.flatShading===!0,sizeAttenuation:w.sizeAttenuation===!0,logarithmicDepthBuffer:u,reverseDepthBuffer:zt,skinning:O.isSkinnedMesh===!0,morphTargets:Y.morphAttributes.position!==void 0,morphNormals:Y.morphAttributes.normal!==void 0,morphColors:Y.morphAttributes.color!==void 0,morphTargetsCount:_t,morphTextureStride:Mt,numDirLights:x.directional.length,numPointLights:x.point.length,numSpotLights:x.spot.length,numSpotLightMaps:x.spotLightMap.length,numRectAreaLights:x.rectArea.length,numHemiLights:x.hemi.length,numDirLightShadows:x.directionalShadowMap.length,numPointLightShadows:x.pointShadowMap.length,numSpotLightShadows:x.spotShadowMap.length,numSpotLightShadowsWithMaps:x.numSpotLightShadowsWithMaps,numLightProbes:x.numLightProbes,numClippingPlanes:o.numPlanes,numClipIntersection:o.numIntersection,dithering:w.dithering,shadowMapEnabled:i.shadowMap.enabled&&R.length>0,shadowMapType:i.shadowMap.type,toneMapping:Oe,decodeVideoTexture:le&&w.map.isVideoTexture===!0&&ue.getTransfer(w.map.colorSpace)===Te,decodeVideoTextureEmissive:fe&&w.emissiveMap.isVideoTexture===!0&&ue.getTransfer(w.emissiveMap.colorSpace)===Te,premultipliedAlpha:w.premultipliedAlpha,doubleSided:w.side===ki,flipSided:w.side===Gn,useDepthPacking:w.depthPacking>=0,depthPacking:w.depthPacking||0,index0AttributeName:w.index0AttributeName,extensionClipCullDistance:Jt&&w.extensions.clipCullDistance===!0&&n.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Jt&&w.extensions.multiDraw===!0||Ut)&&n.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:n.has("KHR_parallel_shader_compile"),customProgramCacheKey:w.customProgramCacheKey()};return fn.vertexUv1s=c.has(1),fn.vertexUv2s=c.has(2),fn.vertexUv3s=c.has(3),c.clear(),fn}function d(w){const x=[];if(w.shaderID?x.push(w.shaderID):(x.push(w.customVertexShaderID),x.push(w.customFragmentShaderID)),w.defines!==void 0)for(const R in w.defines)x.push(R),x.push(w.defines[R]);return w.isRawShaderMaterial===!1&&(S(x,w),E(x,w),x.push(i.outputColorSpace)),x.push(w.customProgramCacheKey),x.join()}function S(w,x){w.push(x.precision),w.push(x.outputColorSpace),w.push(x.envMapMode),w.push(x.envMapCubeUVHeight),w.push(x.mapUv),w.push(x.alphaMapUv),w.push(x.lightMapUv),w.push(x.aoMapUv),w.push(x.bumpMapUv),w.push(x.normalMapUv),w.push(x.displacementMapUv),w.push(x.emissiveMapUv),w.push(x.metalnessMapUv),w.push(x.roughnessMapUv),w.push(x.anisotropyMapUv),w.push(x.clearcoatMapUv),w.push(x.clearcoatNormalMapUv),w.push(x.clearcoatRoughnessMapUv),w.push(x.iridescenceMapUv),w.push(x.iridescenceThicknessMapUv),w.push(x.sheenColorMapUv),w.push(x.sheenRoughnessMapUv),w.push(x.specularMapUv),w.push(x.specularColorMapUv),w.push(x.specularIntensityMapUv),w.push(x.transmissionMapUv),w.push(x.thicknessMapUv),w.push(x.combine),w.push(x.fogExp2),w.push(x.sizeAttenuation),w.push(x.morphTargetsCount),w.push(x.morphAttributeCount),w.push(x.numDirLights),w.push(x.numPointLights),w.push(x.numSpotLights),w.push(x.numSpotLightMaps),w.push(x.numHemiLights),w.push(x.numRectAreaLights),w.push(x.numDirLightShadows),w.push(x.numPointLightShadows),w.push(x.numSpotLightShadows),w.push(x.numSpotLightShadowsWithMaps),w.push(x.numLightProbes),w.push(x.shadowMapType),w.push(x.toneMapping),w.push(x.numClippingPlanes),w.push(x.numClipIntersection),w.push(x.depthPacking)}function E(w,x){a.disableAll(),x.supportsVertexTextures&&a.enable(0),x.instancing&&a.enable(1),x.instancingColor&&a.enable(2),x.instancingMorph&&a.enable(3),x.matcap&&a.enable(4),x.envMap&&a.enable(5),x.normalMapObjectSpace&&a.enable(6),x.normalMapTangentSpace&&a.enable(7),x.clearcoat&&a.enable(8),x.iridescence&&a.enable(9),x.alphaTest&&a.enable(10),x.vertexColors&&a.enable(11),x.vertexAlphas&&a.enable(12),x.vertexUv1s&&a.enable(13),x.vertexUv2s&&a.enable(14),x.vertexUv3s&&a.enable(15),x.vertexTangents&&a.enable(16),x.anisotropy&&a.enable(17),x.alphaHash&&a.enable(18),x.batching&&a.enable(19),x.dispersion&&a.enable(20),x.batchingColor&&a.enable(21),w.push(a.mask),a.disableAll(),x.fog&&a.enable(0),x.useFog&&a.enable(1),x.flatShading&&a.enable(2),x.logarithmicDepthBuffer&&a.enable(3),x.reverseDepthBuffer&&a.enable(4),x.skinning&&a.enable(5),x.morphTargets&&a.enable(6),x.morphNormals&&a.enable(7),x.morphColors&&a.enable(8),x.premultipliedAlpha&&a.enable(9),x.shadowMapEnabled&&a.enable(10),x.doubleSided&&a.enable(11),x.flipSided&&a.enable(12),x.useDepthPacking&&a.enable(13),x.dithering&&a.enable(14),x.transmission&&a.enable(15),x.sheen&&a.enable(16),x.opaque&&a.enable(17),x.pointsUvs&&a.enable(18),x.decodeVideoTexture&&a.enable(19),x.decodeVideoTextureEmissive&&a.enable(20),x.alphaToCoverage&&a.enable(21),w.push(a.mask)}function v(w){const x=_[w.type];let R;if(x){const G=Oi[x];R=bx.clone(G.uniforms)}else R=w.uniforms;return R}function U(w,x){let R;for(let G=0,O=h.length;G<O;G++){const $=h[G];if($.cacheKey===x){R=$,++R.usedTimes;break}}return R===void 0&&(R=new Lw(i,x,w,r),h.push(R)),R}function P(w){if(--w.usedTimes===0){const x=h.indexOf(w);h[x]=h[h.length-1],h.pop(),w.destroy()}}function I(w){l.remove(w)}function F(){l.dispose()}return{getParameters:m,getProgramCacheKey:d,getUniforms:v,acquireProgram:U,releaseProgram:P,releaseShaderCache:I,programs:h,dispose:F}}function Nw(){let i=new WeakMap;function t(o){return i.has(o)}function e(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:t,get:e,remove:n,update:s,dispose:r}}function Ow(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.material.id!==t.material.id?i.material.id-t.material.id:i.z!==t.z?i.z-t.z:i.id-t.id}function tp(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.z!==t.z?t.z-i.z:i.id-t.id}function ep(){const i=[];let t=0;const e=[],n=[],s=[];function r(){t=0,e.length=0,n.length=0,s.length=0}function o(u,f,p,_,b,m){let d=i[t];return d===void 0?(d={id:u.id,object:u,geometry:f,material:p,groupOrder:_,renderOrder:u.renderOrder,z:b,group:m},i[t]=d):(d.id=u.id,d.object=u,d.geometry=f,d.material=p,d.groupOrder=_,d.renderOrder=u.renderOrder,d.z=b,d.group=m),t++,d}function a(u,f,p,_,b,m){const d=o(u,f,p,_,b,m);p.transmission>0?n.push(d):p.transparent===!0?s.push(d):e.push(d)}function l(u,f,p,_,b,m){const d=o(u,f,p,_,b,m);p.transmission>0?n.unshift(d):p.transparent===!0?s.unshift(d):e.unshift(d)}function c(u,f){e.length>1&&e.sort(u||Ow),n.length>1&&n.sort(f||tp),s.length>1&&s.sort(f||tp)}function h(){for(let u=t,f=i.length;u<f;u++){const p=i[u];if(p.id===null)break;p.id=null,p.object=null,p.geometry=null,p.material=null,p.group=null}}return{opaque:e,transmissive:n,transparent:s,init:r,push:a,unshift:l,finish:h,sort:c}}function kw(){let i=new WeakMap;function t(n,s){const r=i.get(n);let o;return r===void 0?(o=new ep,i.set(n,[o])):s>=r.length?(o=new ep,r.push(o)):o=r[s],o}function e(){i=new WeakMap}return{get:t,dispose:e}}function Bw(){const i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"DirectionalLight":e={direction:new D,color:new ie};break;case"SpotLight":e={position:new D,direction:new D,color:new ie,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new D,color:new ie,distance:0,decay:0};break;case"HemisphereLight":e={direction:new D,skyColor:new ie,groundColor:new ie};break;case"RectAreaLight":e={color:new ie,position:new D,halfWidth:new D,halfHeight:new D};break}return i[t.id]=e,e}}}function zw(){const i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new qt};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new qt};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new qt,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[t.id]=e,e}}}let Vw=0;function Hw(i,t){return(t.castShadow?2:0)-(i.castShadow?2:0)+(t.map?1:0)-(i.map?1:0)}function Gw(i){const t=new Bw,e=zw(),n={version:0,hash:{directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new D);const s=new D,r=new Re,o=new Re;function a(c){let h=0,u=0,f=0;for(let w=0;w<9;w++)n.probe[w].set(0,0,0);let p=0,_=0,b=0,m=0,d=0,S=0,E=0,v=0,U=0,P=0,I=0;c.sort(Hw);for(let w=0,x=c.length;w<x;w++){const R=c[w],G=R.color,O=R.intensity,$=R.distance,Y=R.shadow&&R.shadow.map?R.shadow.map.texture:null;if(R.isAmbientLight)h+=G.r*O,u+=G.g*O,f+=G.b*O;else if(R.isLightProbe){for(let J=0;J<9;J++)n.probe[J].addScaledVector(R.sh.coefficients[J],O);I++}else if(R.isDirectionalLight){const J=t.get(R);if(J.color.copy(R.color).multiplyScalar(R.intensity),R.castShadow){const K=R.shadow,et=e.get(R);et.shadowIntensity=K.intensity,et.shadowBias=K.bias,et.shadowNormalBias=K.normalBias,et.shadowRadius=K.radius,et.shadowMapSize=K.mapSize,n.directionalShadow[p]=et,n.directionalShadowMap[p]=Y,n.directionalShadowMatrix[p]=R.shadow.matrix,S++}n.directional[p]=J,p++}else if(R.isSpotLight){const J=t.get(R);J.position.setFromMatrixPosition(R.matrixWorld),J.color.copy(G).multiplyScalar(O),J.distance=$,J.coneCos=Math.cos(R.angle),J.penumbraCos=Math.cos(R.angle*(1-R.penumbra)),J.decay=R.decay,n.spot[b]=J;const K=R.shadow;if(R.map&&(n.spotLightMap[U]=R.map,U++,K.updateMatrices(R),R.castShadow&&P++),n.spotLightMatrix[b]=K.matrix,R.castShadow){const et=e.get(R);et.shadowIntensity=K.intensity,et.shadowBias=K.bias,et.shadowNormalBias=K.normalBias,et.shadowRadius=K.radius,et.shadowMapSize=K.mapSize,n.spotShadow[b]=et,n.spotShadowMap[b]=Y,v++}b++}else if(R.isRectAreaLight){const J=t.get(R);J.color.copy(G).multiplyScalar(O),J.halfWidth.set(R.width*.5,0,0),J.halfHeight.set(0,R.height*.5,0),n.rectArea[m]=J,m++}else if(R.isPointLight){const J=t.get(R);if(J.color.copy(R.color).multiplyScalar(R.intensity),J.distance=R.distance,J.decay=R.decay,R.castShadow){const K=R.shadow,et=e.get(R);et.shadowIntensity=K.intensity,et.shadowBias=K.bias,et.shadowNormalBias=K.normalBias,et.shadowRadius=K.radius,et.shadowMapSize=K.mapSize,et.shadowCameraNear=K.camera.near,et.shadowCameraFar=K.camera.far,n.pointShadow[_]=et,n.pointShadowMap[_]=Y,n.pointShadowMatrix[_]=R.shadow.matrix,E++}n.point[_]=J,_++}else if(R.isHemisphereLight){const J=t.get(R);J.skyColor.copy(R.color).multiplyScalar(O),J.groundColor.copy(R.groundColor).multiplyScalar(O),n.hemi[d]=J,d++}}m>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=Et.LTC_FLOAT_1,n.rectAreaLTC2=Et.LTC_FLOAT_2):(n.rectAreaLTC1=Et.LTC_HALF_1,n.rectAreaLTC2=Et.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=u,n.ambient[2]=f;const F=n.hash;(F.directionalLength!==p||F.pointLength!==_||F.spotLength!==b||F.rectAreaLength!==m||F.hemiLength!==d||F.numDirectionalShadows!==S||F.numPointShadows!==E||F.numSpotShadows!==v||F.numSpotMaps!==U||F.numLightProbes!==I)&&(n.directional.length=p,n.spot.length=b,n.rectArea.length=m,n.point.length=_,n.hemi.length=d,n.directionalShadow.length=S,n.directionalShadowMap.length=S,n.pointShadow.length=E,n.pointShadowMap.length=E,n.spotShadow.length=v,n.spotShadowMap.length=v,n.directionalShadowMatrix.length=S,n.pointShadowMatrix.length=E,n.spotLightMatrix.length=v+U-P,n.spotLightMap.length=U,n.numSpotLightShadowsWithMaps=P,n.numLightProbes=I,F.directionalLength=p,F.pointLength=_,F.spotLength=b,F.rectAreaLength=m,F.hemiLength=d,F.numDirectionalShadows=S,F.numPointShadows=E,F.numSpotShadows=v,F.numSpotMaps=U,F.numLightProbes=I,n.version=Vw++)}function l(c,h){let u=0,f=0,p=0,_=0,b=0;const m=h.matrixWorldInverse;for(let d=0,S=c.length;d<S;d++){const E=c[d];if(E.isDirectionalLight){const v=n.directional[u];v.direction.setFromMatrixPosition(E.matrixWorld),s.setFromMatrixPosition(E.target.matrixWorld),v.direction.sub(s),v.direction.transformDirection(m),u++}else if(E.isSpotLight){const v=n.spot[p];v.position.setFromMatrixPosition(E.matrixWorld),v.position.applyMatrix4(m),v.direction.setFromMatrixPosition(E.matrixWorld),s.setFromMatrixPosition(E.target.matrixWorld),v.direction.sub(s),v.direction.transformDirection(m),p++}else if(E.isRectAreaLight){const v=n.rectArea[_];v.position.setFromMatrixPosition(E.matrixWorld),v.position.applyMatrix4(m),o.identity(),r.copy(E.matrixWorld),r.premultiply(m),o.extractRotation(r),v.halfWidth.set(E.width*.5,0,0),v.halfHeight.set(0,E.height*.5,0),v.halfWidth.applyMatrix4(o),v.halfHeight.applyMatrix4(o),_++}else if(E.isPointLight){const v=n.point[f];v.position.setFromMatrixPosition(E.matrixWorld),v.position.applyMatrix4(m),f++}else if(E.isHemisphereLight){const v=n.hemi[b];v.direction.setFromMatrixPosition(E.matrixWorld),v.direction.transformDirection(m),b++}}}return{setup:a,setupView:l,state:n}}function np(i){const t=new Gw(i),e=[],n=[];function s(h){c.camera=h,e.length=0,n.length=0}function r(h){e.push(h)}function o(h){n.push(h)}function a(){t.setup(e)}function l(h){t.setupView(e,h)}const c={lightsArray:e,shadowsArray:n,camera:null,lights:t,transmissionRenderTarget:{}};return{init:s,state:c,setupLights:a,setupLightsView:l,pushLight:r,pushShadow:o}}function Ww(i){let t=new WeakMap;function e(s,r=0){const o=t.get(s);let a;return o===void 0?(a=new np(i),t.set(s,[a])):r>=o.length?(a=new np(i),o.push(a)):a=o[r],a}function n(){t=new WeakMap}return{get:e,dispose:n}}class Xw extends Ds{static get type(){return"MeshDepthMaterial"}constructor(t){super(),this.isMeshDepthMaterial=!0,this.depthPacking=zv,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}}class Yw extends Ds{static get type(){return"MeshDistanceMaterial"}constructor(t){super(),this.isMeshDistanceMaterial=!0,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}}const qw=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,jw=`uniform sampler2D shadow_pass;
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
}`;function $w(i,t,e){let n=new Fu;const s=new qt,r=new qt,o=new ze,a=new Xw({depthPacking:Vv}),l=new Yw,c={},h=e.maxTextureSize,u={[as]:Gn,[Gn]:as,[ki]:ki},f=new cs({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new qt},radius:{value:4}},vertexShader:qw,fragmentShader:jw}),p=f.clone();p.defines.HORIZONTAL_PASS=1;const _=new xn;_.setAttribute("position",new We(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));const b=new an(_,f),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Um;let d=this.type;this.render=function(P,I,F){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||P.length===0)return;const w=i.getRenderTarget(),x=i.getActiveCubeFace(),R=i.getActiveMipmapLevel(),G=i.state;G.setBlending(rs),G.buffers.color.setClear(1,1,1,1),G.buffers.depth.setTest(!0),G.setScissorTest(!1);const O=d!==$i&&this.type===$i,$=d===$i&&this.type!==$i;for(let Y=0,J=P.length;Y<J;Y++){const K=P[Y],et=K.shadow;if(et===void 0){console.warn("THREE.WebGLShadowMap:",K,"has no shadow.");continue}if(et.autoUpdate===!1&&et.needsUpdate===!1)continue;s.copy(et.mapSize);const ft=et.getFrameExtents();if(s.multiply(ft),r.copy(et.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/ft.x),s.x=r.x*ft.x,et.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/ft.y),s.y=r.y*ft.y,et.mapSize.y=r.y)),et.map===null||O===!0||$===!0){const _t=this.type!==$i?{minFilter:Cn,magFilter:Cn}:{};et.map!==null&&et.map.dispose(),et.map=new Cs(s.x,s.y,_t),et.map.texture.name=K.name+".shadowMap",et.camera.updateProjectionMatrix()}i.setRenderTarget(et.map),i.clear();const ht=et.getViewportCount();for(let _t=0;_t<ht;_t++){const Mt=et.getViewport(_t);o.set(r.x*Mt.x,r.y*Mt.y,r.x*Mt.z,r.y*Mt.w),G.viewport(o),et.updateMatrices(K,_t),n=et.getFrustum(),v(I,F,et.camera,K,this.type)}et.isPointLightShadow!==!0&&this.type===$i&&S(et,F),et.needsUpdate=!1}d=this.type,m.needsUpdate=!1,i.setRenderTarget(w,x,R)};function S(P,I){const F=t.update(b);f.defines.VSM_SAMPLES!==P.blurSamples&&(f.defines.VSM_SAMPLES=P.blurSamples,p.defines.VSM_SAMPLES=P.blurSamples,f.needsUpdate=!0,p.needsUpdate=!0),P.mapPass===null&&(P.mapPass=new Cs(s.x,s.y)),f.uniforms.shadow_pass.value=P.map.texture,f.uniforms.resolution.value=P.mapSize,f.uniforms.radius.value=P.radius,i.setRenderTarget(P.mapPass),i.clear(),i.renderBufferDirect(I,null,F,f,b,null),p.uniforms.shadow_pass.value=P.mapPass.texture,p.uniforms.resolution.value=P.mapSize,p.uniforms.radius.value=P.radius,i.setRenderTarget(P.map),i.clear(),i.renderBufferDirect(I,null,F,p,b,null)}function E(P,I,F,w){let x=null;const R=F.isPointLight===!0?P.customDistanceMaterial:P.customDepthMaterial;if(R!==void 0)x=R;else if(x=F.isPointLight===!0?l:a,i.localClippingEnabled&&I.clipShadows===!0&&Array.isArray(I.clippingPlanes)&&I.clippingPlanes.length!==0||I.displacementMap&&I.displacementScale!==0||I.alphaMap&&I.alphaTest>0||I.map&&I.alphaTest>0){const G=x.uuid,O=I.uuid;let $=c[G];$===void 0&&($={},c[G]=$);let Y=$[O];Y===void 0&&(Y=x.clone(),$[O]=Y,I.addEventListener("dispose",U)),x=Y}if(x.visible=I.visible,x.wireframe=I.wireframe,w===$i?x.side=I.shadowSide!==null?I.shadowSide:I.side:x.side=I.shadowSide!==null?I.shadowSide:u[I.side],x.alphaMap=I.alphaMap,x.alphaTest=I.alphaTest,x.map=I.map,x.clipShadows=I.clipShadows,x.clippingPlanes=I.clippingPlanes,x.clipIntersection=I.clipIntersection,x.displacementMap=I.displacementMap,x.displacementScale=I.displacementScale,x.displacementBias=I.displacementBias,x.wireframeLinewidth=I.wireframeLinewidth,x.linewidth=I.linewidth,F.isPointLight===!0&&x.isMeshDistanceMaterial===!0){const G=i.properties.get(x);G.light=F}return x}function v(P,I,F,w,x){if(P.visible===!1)return;if(P.layers.test(I.layers)&&(P.isMesh||P.isLine||P.isPoints)&&(P.castShadow||P.receiveShadow&&x===$i)&&(!P.frustumCulled||n.intersectsObject(P))){P.modelViewMatrix.multiplyMatrices(F.matrixWorldInverse,P.matrixWorld);const O=t.update(P),$=P.material;if(Array.isArray($)){const Y=O.groups;for(let J=0,K=Y.length;J<K;J++){const et=Y[J],ft=$[et.materialIndex];if(ft&&ft.visible){const ht=E(P,ft,w,x);P.onBeforeShadow(i,P,I,F,O,ht,et),i.renderBufferDirect(F,null,O,ht,P,et),P.onAfterShadow(i,P,I,F,O,ht,et)}}}else if($.visible){const Y=E(P,$,w,x);P.onBeforeShadow(i,P,I,F,O,Y,null),i.renderBufferDirect(F,null,O,Y,P,null),P.onAfterShadow(i,P,I,F,O,Y,null)}}const G=P.children;for(let O=0,$=G.length;O<$;O++)v(G[O],I,F,w,x)}function U(P){P.target.removeEventListener("dispose",U);for(const F in c){const w=c[F],x=P.target.uuid;x in w&&(w[x].dispose(),delete w[x])}}}const Zw={[gh]:bh,[vh]:Sh,[xh]:yh,[co]:Mh,[bh]:gh,[Sh]:vh,[yh]:xh,[Mh]:co};function Kw(i,t){function e(){let z=!1;const xt=new ze;let it=null;const ot=new ze(0,0,0,0);return{setMask:function(At){it!==At&&!z&&(i.colorMask(At,At,At,At),it=At)},setLocked:function(At){z=At},setClear:function(At,Rt,Jt,Oe,fn){fn===!0&&(At*=Oe,Rt*=Oe,Jt*=Oe),xt.set(At,Rt,Jt,Oe),ot.equals(xt)===!1&&(i.clearColor(At,Rt,Jt,Oe),ot.copy(xt))},reset:function(){z=!1,it=null,ot.set(-1,0,0,0)}}}function n(){let z=!1,xt=!1,it=null,ot=null,At=null;return{setReversed:function(Rt){if(xt!==Rt){const Jt=t.get("EXT_clip_control");xt?Jt.clipControlEXT(Jt.LOWER_LEFT_EXT,Jt.ZERO_TO_ONE_EXT):Jt.clipControlEXT(Jt.LOWER_LEFT_EXT,Jt.NEGATIVE_ONE_TO_ONE_EXT);const Oe=At;At=null,this.setClear(Oe)}xt=Rt},getReversed:function(){return xt},setTest:function(Rt){Rt?at(i.DEPTH_TEST):zt(i.DEPTH_TEST)},setMask:function(Rt){it!==Rt&&!z&&(i.depthMask(Rt),it=Rt)},setFunc:function(Rt){if(xt&&(Rt=Zw[Rt]),ot!==Rt){switch(Rt){case gh:i.depthFunc(i.NEVER);break;case bh:i.depthFunc(i.ALWAYS);break;case vh:i.depthFunc(i.LESS);break;case co:i.depthFunc(i.LEQUAL);break;case xh:i.depthFunc(i.EQUAL);break;case Mh:i.depthFunc(i.GEQUAL);break;case Sh:i.depthFunc(i.GREATER);break;case yh:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}ot=Rt}},setLocked:function(Rt){z=Rt},setClear:function(Rt){At!==Rt&&(xt&&(Rt=1-Rt),i.clearDepth(Rt),At=Rt)},reset:function(){z=!1,it=null,ot=null,At=null,xt=!1}}}function s(){let z=!1,xt=null,it=null,ot=null,At=null,Rt=null,Jt=null,Oe=null,fn=null;return{setTest:function(ge){z||(ge?at(i.STENCIL_TEST):zt(i.STENCIL_TEST))},setMask:function(ge){xt!==ge&&!z&&(i.stencilMask(ge),xt=ge)},setFunc:function(ge,en,Ie){(it!==ge||ot!==en||At!==Ie)&&(i.stencilFunc(ge,en,Ie),it=ge,ot=en,At=Ie)},setOp:function(ge,en,Ie){(Rt!==ge||Jt!==en||Oe!==Ie)&&(i.stencilOp(ge,en,Ie),Rt=ge,Jt=en,Oe=Ie)},setLocked:function(ge){z=ge},setClear:function(ge){fn!==ge&&(i.clearStencil(ge),fn=ge)},reset:function(){z=!1,xt=null,it=null,ot=null,At=null,Rt=null,Jt=null,Oe=null,fn=null}}}const r=new e,o=new n,a=new s,l=new WeakMap,c=new WeakMap;let h={},u={},f=new WeakMap,p=[],_=null,b=!1,m=null,d=null,S=null,E=null,v=null,U=null,P=null,I=new ie(0,0,0),F=0,w=!1,x=null,R=null,G=null,O=null,$=null;const Y=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS);let J=!1,K=0;const et=i.getParameter(i.VERSION);et.indexOf("WebGL")!==-1?(K=parseFloat(/^WebGL (\d)/.exec(et)[1]),J=K>=1):et.indexOf("OpenGL ES")!==-1&&(K=parseFloat(/^OpenGL ES (\d)/.exec(et)[1]),J=K>=2);let ft=null,ht={};const _t=i.getParameter(i.SCISSOR_BOX),Mt=i.getParameter(i.VIEWPORT),mt=new ze().fromArray(_t),st=new ze().fromArray(Mt);function lt(z,xt,it,ot){const At=new Uint8Array(4),Rt=i.createTexture();i.bindTexture(z,Rt),i.texParameteri(z,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(z,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Jt=0;Jt<it;Jt++)z===i.TEXTURE_3D||z===i.TEXTURE_2D_ARRAY?i.texImage3D(xt,0,i.RGBA,1,1,ot,0,i.RGBA,i.UNSIGNED_BYTE,At):i.texImage2D(xt+Jt,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,At);return Rt}const gt={};gt[i.TEXTURE_2D]=lt(i.TEXTURE_2D,i.TEXTURE_2D,1),gt[i.TEXTURE_CUBE_MAP]=lt(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),gt[i.TEXTURE_2D_ARRAY]=lt(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),gt[i.TEXTURE_3D]=lt(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),at(i.DEPTH_TEST),o.setFunc(co),Qt(!1),ee(ad),at(i.CULL_FACE),V(rs);function at(z){h[z]!==!0&&(i.enable(z),h[z]=!0)}function zt(z){h[z]!==!1&&(i.disable(z),h[z]=!1)}function Ht(z,xt){return u[z]!==xt?(i.bindFramebuffer(z,xt),u[z]=xt,z===i.DRAW_FRAMEBUFFER&&(u[i.FRAMEBUFFER]=xt),z===i.FRAMEBUFFER&&(u[i.DRAW_FRAMEBUFFER]=xt),!0):!1}function Ut(z,xt){let it=p,ot=!1;if(z){it=f.get(xt),it===void 0&&(it=[],f.set(xt,it));const At=z.textures;if(it.length!==At.length||it[0]!==i.COLOR_ATTACHMENT0){for(let Rt=0,Jt=At.length;Rt<Jt;Rt++)it[Rt]=i.COLOR_ATTACHMENT0+Rt;it.length=At.length,ot=!0}}else it[0]!==i.BACK&&(it[0]=i.BACK,ot=!0);ot&&i.drawBuffers(it)}function le(z){return _!==z?(i.useProgram(z),_=z,!0):!1}const Kt={[ir]:i.FUNC_ADD,[dv]:i.FUNC_SUBTRACT,[pv]:i.FUNC_REVERSE_SUBTRACT};Kt[mv]=i.MIN,Kt[_v]=i.MAX;const ce={[gv]:i.ZERO,[bv]:i.ONE,[vv]:i.SRC_COLOR,[mh]:i.SRC_ALPHA,[Ev]:i.SRC_ALPHA_SATURATE,[yv]:i.DST_COLOR,[Mv]:i.DST_ALPHA,[xv]:i.ONE_MINUS_SRC_COLOR,[_h]:i.ONE_MINUS_SRC_ALPHA,[wv]:i.ONE_MINUS_DST_COLOR,[Sv]:i.ONE_MINUS_DST_ALPHA,[Tv]:i.CONSTANT_COLOR,[Av]:i.ONE_MINUS_CONSTANT_COLOR,[Rv]:i.CONSTANT_ALPHA,[Pv]:i.ONE_MINUS_CONSTANT_ALPHA};function V(z,xt,it,ot,At,Rt,Jt,Oe,fn,ge){if(z===rs){b===!0&&(zt(i.BLEND),b=!1);return}if(b===!1&&(at(i.BLEND),b=!0),z!==fv){if(z!==m||ge!==w){if((d!==ir||v!==ir)&&(i.blendEquation(i.FUNC_ADD),d=ir,v=ir),ge)switch(z){case to:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case ld:i.blendFunc(i.ONE,i.ONE);break;case cd:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case hd:i.blendFuncSeparate(i.ZERO,i.SRC_COLOR,i.ZERO,i.SRC_ALPHA);break;default:console.error("THREE.WebGLState: Invalid blending: ",z);break}else switch(z){case to:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case ld:i.blendFunc(i.SRC_ALPHA,i.ONE);break;case cd:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case hd:i.blendFunc(i.ZERO,i.SRC_COLOR);break;default:console.error("THREE.WebGLState: Invalid blending: ",z);break}S=null,E=null,U=null,P=null,I.set(0,0,0),F=0,m=z,w=ge}return}At=At||xt,Rt=Rt||it,Jt=Jt||ot,(xt!==d||At!==v)&&(i.blendEquationSeparate(Kt[xt],Kt[At]),d=xt,v=At),(it!==S||ot!==E||Rt!==U||Jt!==P)&&(i.blendFuncSeparate(ce[it],ce[ot],ce[Rt],ce[Jt]),S=it,E=ot,U=Rt,P=Jt),(Oe.equals(I)===!1||fn!==F)&&(i.blendColor(Oe.r,Oe.g,Oe.b,fn),I.copy(Oe),F=fn),m=z,w=!1}function tn(z,xt){z.side===ki?zt(i.CULL_FACE):at(i.CULL_FACE);let it=z.side===Gn;xt&&(it=!it),Qt(it),z.blending===to&&z.transparent===!1?V(rs):V(z.blending,z.blendEquation,z.blendSrc,z.blendDst,z.blendEquationAlpha,z.blendSrcAlpha,z.blendDstAlpha,z.blendColor,z.blendAlpha,z.premultipliedAlpha),o.setFunc(z.depthFunc),o.setTest(z.depthTest),o.setMask(z.depthWrite),r.setMask(z.colorWrite);const ot=z.stencilWrite;a.setTest(ot),ot&&(a.setMask(z.stencilWriteMask),a.setFunc(z.stencilFunc,z.stencilRef,z.stencilFuncMask),a.setOp(z.stencilFail,z.stencilZFail,z.stencilZPass)),fe(z.polygonOffset,z.polygonOffsetFactor,z.polygonOffsetUnits),z.alphaToCoverage===!0?at(i.SAMPLE_ALPHA_TO_COVERAGE):zt(i.SAMPLE_ALPHA_TO_COVERAGE)}function Qt(z){x!==z&&(z?i.frontFace(i.CW):i.frontFace(i.CCW),x=z)}function ee(z){z!==cv?(at(i.CULL_FACE),z!==R&&(z===ad?i.cullFace(i.BACK):z===hv?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):zt(i.CULL_FACE),R=z}function Gt(z){z!==G&&(J&&i.lineWidth(z),G=z)}function fe(z,xt,it){z?(at(i.POLYGON_OFFSET_FILL),(O!==xt||$!==it)&&(i.polygonOffset(xt,it),O=xt,$=it)):zt(i.POLYGON_OFFSET_FILL)}function Lt(z){z?at(i.SCISSOR_TEST):zt(i.SCISSOR_TEST)}function C(z){z===void 0&&(z=i.TEXTURE0+Y-1),ft!==z&&(i.activeTexture(z),ft=z)}function y(z,xt,it){it===void 0&&(ft===null?it=i.TEXTURE0+Y-1:it=ft);let ot=ht[it];ot===void 0&&(ot={type:void 0,texture:void 0},ht[it]=ot),(ot.type!==z||ot.texture!==xt)&&(ft!==it&&(i.activeTexture(it),ft=it),i.bindTexture(z,xt||gt[z]),ot.type=z,ot.texture=xt)}function Z(){const z=ht[ft];z!==void 0&&z.type!==void 0&&(i.bindTexture(z.type,null),z.type=void 0,z.texture=void 0)}function Q(){try{i.compressedTexImage2D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function W(){try{i.compressedTexImage3D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function nt(){try{i.texSubImage2D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function St(){try{i.texSubImage3D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function bt(){try{i.compressedTexSubImage2D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function Tt(){try{i.compressedTexSubImage3D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function Zt(){try{i.texStorage2D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function dt(){try{i.texStorage3D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function vt(){try{i.texImage2D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function Nt(){try{i.texImage3D.apply(i,arguments)}catch(z){console.error("THREE.WebGLState:",z)}}function kt(z){mt.equals(z)===!1&&(i.scissor(z.x,z.y,z.z,z.w),mt.copy(z))}function wt(z){st.equals(z)===!1&&(i.viewport(z.x,z.y,z.z,z.w),st.copy(z))}function se(z,xt){let it=c.get(xt);it===void 0&&(it=new WeakMap,c.set(xt,it));let ot=it.get(z);ot===void 0&&(ot=i.getUniformBlockIndex(xt,z.name),it.set(z,ot))}function jt(z,xt){const ot=c.get(xt).get(z);l.get(xt)!==ot&&(i.uniformBlockBinding(xt,ot,z.__bindingPointIndex),l.set(xt,ot))}function de(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),o.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),h={},ft=null,ht={},u={},f=new WeakMap,p=[],_=null,b=!1,m=null,d=null,S=null,E=null,v=null,U=null,P=null,I=new ie(0,0,0),F=0,w=!1,x=null,R=null,G=null,O=null,$=null,mt.set(0,0,i.canvas.width,i.canvas.height),st.set(0,0,i.canvas.width,i.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:at,disable:zt,bindFramebuffer:Ht,drawBuffers:Ut,useProgram:le,setBlending:V,setMaterial:tn,setFlipSided:Qt,setCullFace:ee,setLineWidth:Gt,setPolygonOffset:fe,setScissorTest:Lt,activeTexture:C,bindTexture:y,unbindTexture:Z,compressedTexImage2D:Q,compressedTexImage3D:W,texImage2D:vt,texImage3D:Nt,updateUBOMapping:se,uniformBlockBinding:jt,texStorage2D:Zt,texStorage3D:dt,texSubImage2D:nt,texSubImage3D:St,compressedTexSubImage2D:bt,compressedTexSubImage3D:Tt,scissor:kt,viewport:wt,reset:de}}function ip(i,t,e,n){const s=Jw(n);switch(e){case Bm:return i*t;case Vm:return i*t;case Hm:return i*t*2;case Ru:return i*t/s.components*s.byteLength;case Pu:return i*t/s.components*s.byteLength;case Gm:return i*t*2/s.components*s.byteLength;case Cu:return i*t*2/s.components*s.byteLength;case zm:return i*t*3/s.components*s.byteLength;case wi:return i*t*4/s.components*s.byteLength;case Ol:return i*t*4/s.components*s.byteLength;case qa:case ja:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case $a:case Za:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Ph:case Lh:return Math.max(i,16)*Math.max(t,8)/4;case Rh:case Ch:return Math.max(i,8)*Math.max(t,8)/2;case Ih:case Fh:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case Dh:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Uh:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case Nh:return Math.floor((i+4)/5)*Math.floor((t+3)/4)*16;case Oh:return Math.floor((i+4)/5)*Math.floor((t+4)/5)*16;case kh:return Math.floor((i+5)/6)*Math.floor((t+4)/5)*16;case Bh:return Math.floor((i+5)/6)*Math.floor((t+5)/6)*16;case zh:return Math.floor((i+7)/8)*Math.floor((t+4)/5)*16;case Vh:return Math.floor((i+7)/8)*Math.floor((t+5)/6)*16;case Hh:return Math.floor((i+7)/8)*Math.floor((t+7)/8)*16;case Gh:return Math.floor((i+9)/10)*Math.floor((t+4)/5)*16;case Wh:return Math.floor((i+9)/10)*Math.floor((t+5)/6)*16;case Xh:return Math.floor((i+9)/10)*Math.floor((t+7)/8)*16;case Yh:return Math.floor((i+9)/10)*Math.floor((t+9)/10)*16;case qh:return Math.floor((i+11)/12)*Math.floor((t+9)/10)*16;case jh:return Math.floor((i+11)/12)*Math.floor((t+11)/12)*16;case Ka:case $h:case Zh:return Math.ceil(i/4)*Math.ceil(t/4)*16;case Wm:case Kh:return Math.ceil(i/4)*Math.ceil(t/4)*8;case Jh:case Qh:return Math.ceil(i/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function Jw(i){switch(i){case ls:case Om:return{byteLength:1,components:1};case Ko:case Eu:case ta:return{byteLength:2,components:1};case Tu:case Au:return{byteLength:2,components:4};case ur:case Nl:case yi:return{byteLength:4,components:1};case km:return{byteLength:4,components:3}}throw new Error(`Unknown texture type ${i}.`)}function Qw(i,t,e,n,s,r,o){const a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new qt,h=new WeakMap;let u;const f=new WeakMap;let p=!1;try{p=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function _(C,y){return p?new OffscreenCanvas(C,y):xl("canvas")}function b(C,y,Z){let Q=1;const W=Lt(C);if((W.width>Z||W.height>Z)&&(Q=Z/Math.max(W.width,W.height)),Q<1)if(typeof HTMLImageElement<"u"&&C instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&C instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&C instanceof ImageBitmap||typeof VideoFrame<"u"&&C instanceof VideoFrame){const nt=Math.floor(Q*W.width),St=Math.floor(Q*W.height);u===void 0&&(u=_(nt,St));const bt=y?_(nt,St):u;return bt.width=nt,bt.height=St,bt.getContext("2d").drawImage(C,0,0,nt,St),console.warn("THREE.WebGLRenderer: Texture has been resized from ("+W.width+"x"+W.height+") to ("+nt+"x"+St+")."),bt}else return"data"in C&&console.warn("THREE.WebGLRenderer: Image in DataTexture is too big ("+W.width+"x"+W.height+")."),C;return C}function m(C){return C.generateMipmaps}function d(C){i.generateMipmap(C)}function S(C){return C.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:C.isWebGL3DRenderTarget?i.TEXTURE_3D:C.isWebGLArrayRenderTarget||C.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function E(C,y,Z,Q,W=!1){if(C!==null){if(i[C]!==void 0)return i[C];console.warn("THREE.WebGLRenderer: Attempt to use non-existing WebGL internal format '"+C+"'")}let nt=y;if(y===i.RED&&(Z===i.FLOAT&&(nt=i.R32F),Z===i.HALF_FLOAT&&(nt=i.R16F),Z===i.UNSIGNED_BYTE&&(nt=i.R8)),y===i.RED_INTEGER&&(Z===i.UNSIGNED_BYTE&&(nt=i.R8UI),Z===i.UNSIGNED_SHORT&&(nt=i.R16UI),Z===i.UNSIGNED_INT&&(nt=i.R32UI),Z===i.BYTE&&(nt=i.R8I),Z===i.SHORT&&(nt=i.R16I),Z===i.INT&&(nt=i.R32I)),y===i.RG&&(Z===i.FLOAT&&(nt=i.RG32F),Z===i.HALF_FLOAT&&(nt=i.RG16F),Z===i.UNSIGNED_BYTE&&(nt=i.RG8)),y===i.RG_INTEGER&&(Z===i.UNSIGNED_BYTE&&(nt=i.RG8UI),Z===i.UNSIGNED_SHORT&&(nt=i.RG16UI),Z===i.UNSIGNED_INT&&(nt=i.RG32UI),Z===i.BYTE&&(nt=i.RG8I),Z===i.SHORT&&(nt=i.RG16I),Z===i.INT&&(nt=i.RG32I)),y===i.RGB_INTEGER&&(Z===i.UNSIGNED_BYTE&&(nt=i.RGB8UI),Z===i.UNSIGNED_SHORT&&(nt=i.RGB16UI),Z===i.UNSIGNED_INT&&(nt=i.RGB32UI),Z===i.BYTE&&(nt=i.RGB8I),Z===i.SHORT&&(nt=i.RGB16I),Z===i.INT&&(nt=i.RGB32I)),y===i.RGBA_INTEGER&&(Z===i.UNSIGNED_BYTE&&(nt=i.RGBA8UI),Z===i.UNSIGNED_SHORT&&(nt=i.RGBA16UI),Z===i.UNSIGNED_INT&&(nt=i.RGBA32UI),Z===i.BYTE&&(nt=i.RGBA8I),Z===i.SHORT&&(nt=i.RGBA16I),Z===i.INT&&(nt=i.RGBA32I)),y===i.RGB&&Z===i.UNSIGNED_INT_5_9_9_9_REV&&(nt=i.RGB9_E5),y===i.RGBA){const St=W?kl:ue.getTransfer(Q);Z===i.FLOAT&&(nt=i.RGBA32F),Z===i.HALF_FLOAT&&(nt=i.RGBA16F),Z===i.UNSIGNED_BYTE&&(nt=St===Te?i.SRGB8_ALPHA8:i.RGBA8),Z===i.UNSIGNED_SHORT_4_4_4_4&&(nt=i.RGBA4),Z===i.UNSIGNED_SHORT_5_5_5_1&&(nt=i.RGB5_A1)}return(nt===i.R16F||nt===i.R32F||nt===i.RG16F||nt===i.RG32F||nt===i.RGBA16F||nt===i.RGBA32F)&&t.get("EXT_color_buffer_float"),nt}function v(C,y){let Z;return C?y===null||y===ur||y===fo?Z=i.DEPTH24_STENCIL8:y===yi?Z=i.DEPTH32F_STENCIL8:y===Ko&&(Z=i.DEPTH24_STENCIL8,console.warn("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):y===null||y===ur||y===fo?Z=i.DEPTH_COMPONENT24:y===yi?Z=i.DEPTH_COMPONENT32F:y===Ko&&(Z=i.DEPTH_COMPONENT16),Z}function U(C,y){return m(C)===!0||C.isFramebufferTexture&&C.minFilter!==Cn&&C.minFilter!==Bi?Math.log2(Math.max(y.width,y.height))+1:C.mipmaps!==void 0&&C.mipmaps.length>0?C.mipmaps.length:C.isCompressedTexture&&Array.isArray(C.image)?y.mipmaps.length:1}function P(C){const y=C.target;y.removeEventListener("dispose",P),F(y),y.isVideoTexture&&h.delete(y)}function I(C){const y=C.target;y.removeEventListener("dispose",I),x(y)}function F(C){const y=n.get(C);if(y.__webglInit===void 0)return;const Z=C.source,Q=f.get(Z);if(Q){const W=Q[y.__cacheKey];W.usedTimes--,W.usedTimes===0&&w(C),Object.keys(Q).length===0&&f.delete(Z)}n.remove(C)}function w(C){const y=n.get(C);i.deleteTexture(y.__webglTexture);const Z=C.source,Q=f.get(Z);delete Q[y.__cacheKey],o.memory.textures--}function x(C){const y=n.get(C);if(C.depthTexture&&(C.depthTexture.dispose(),n.remove(C.depthTexture)),C.isWebGLCubeRenderTarget)for(let Q=0;Q<6;Q++){if(Array.isArray(y.__webglFramebuffer[Q]))for(let W=0;W<y.__webglFramebuffer[Q].length;W++)i.deleteFramebuffer(y.__webglFramebuffer[Q][W]);else i.deleteFramebuffer(y.__webglFramebuffer[Q]);y.__webglDepthbuffer&&i.deleteRenderbuffer(y.__webglDepthbuffer[Q])}else{if(Array.isArray(y.__webglFramebuffer))for(let Q=0;Q<y.__webglFramebuffer.length;Q++)i.deleteFramebuffer(y.__webglFramebuffer[Q]);else i.deleteFramebuffer(y.__webglFramebuffer);if(y.__webglDepthbuffer&&i.deleteRenderbuffer(y.__webglDepthbuffer),y.__webglMultisampledFramebuffer&&i.deleteFramebuffer(y.__webglMultisampledFramebuffer),y.__webglColorRenderbuffer)for(let Q=0;Q<y.__webglColorRenderbuffer.length;Q++)y.__webglColorRenderbuffer[Q]&&i.deleteRenderbuffer(y.__webglColorRenderbuffer[Q]);y.__webglDepthRenderbuffer&&i.deleteRenderbuffer(y.__webglDepthRenderbuffer)}const Z=C.textures;for(let Q=0,W=Z.length;Q<W;Q++){const nt=n.get(Z[Q]);nt.__webglTexture&&(i.deleteTexture(nt.__webglTexture),o.memory.textures--),n.remove(Z[Q])}n.remove(C)}let R=0;function G(){R=0}function O(){const C=R;return C>=s.maxTextures&&console.warn("THREE.WebGLTextures: Trying to use "+C+" texture units while this GPU supports only "+s.maxTextures),R+=1,C}function $(C){const y=[];return y.push(C.wrapS),y.push(C.wrapT),y.push(C.wrapR||0),y.push(C.magFilter),y.push(C.minFilter),y.push(C.anisotropy),y.push(C.internalFormat),y.push(C.format),y.push(C.type),y.push(C.generateMipmaps),y.push(C.premultiplyAlpha),y.push(C.flipY),y.push(C.unpackAlignment),y.push(C.colorSpace),y.join()}function Y(C,y){const Z=n.get(C);if(C.isVideoTexture&&Gt(C),C.isRenderTargetTexture===!1&&C.version>0&&Z.__version!==C.version){const Q=C.image;if(Q===null)console.warn("THREE.WebGLRenderer: Texture marked for update but no image data found.");else if(Q.complete===!1)console.warn("THREE.WebGLRenderer: Texture marked for update but image is incomplete");else{st(Z,C,y);return}}e.bindTexture(i.TEXTURE_2D,Z.__webglTexture,i.TEXTURE0+y)}function J(C,y){const Z=n.get(C);if(C.version>0&&Z.__version!==C.version){st(Z,C,y);return}e.bindTexture(i.TEXTURE_2D_ARRAY,Z.__webglTexture,i.TEXTURE0+y)}function K(C,y){const Z=n.get(C);if(C.version>0&&Z.__version!==C.version){st(Z,C,y);return}e.bindTexture(i.TEXTURE_3D,Z.__webglTexture,i.TEXTURE0+y)}function et(C,y){const Z=n.get(C);if(C.version>0&&Z.__version!==C.version){lt(Z,C,y);return}e.bindTexture(i.TEXTURE_CUBE_MAP,Z.__webglTexture,i.TEXTURE0+y)}const ft={[Th]:i.REPEAT,[rr]:i.CLAMP_TO_EDGE,[Ah]:i.MIRRORED_REPEAT},ht={[Cn]:i.NEAREST,[Bv]:i.NEAREST_MIPMAP_NEAREST,[ma]:i.NEAREST_MIPMAP_LINEAR,[Bi]:i.LINEAR,[uc]:i.LINEAR_MIPMAP_NEAREST,[or]:i.LINEAR_MIPMAP_LINEAR},_t={[Gv]:i.NEVER,[$v]:i.ALWAYS,[Wv]:i.LESS,[Xm]:i.LEQUAL,[Xv]:i.EQUAL,[jv]:i.GEQUAL,[Yv]:i.GREATER,[qv]:i.NOTEQUAL};function Mt(C,y){if(y.type===yi&&t.has("OES_texture_float_linear")===!1&&(y.magFilter===Bi||y.magFilter===uc||y.magFilter===ma||y.magFilter===or||y.minFilter===Bi||y.minFilter===uc||y.minFilter===ma||y.minFilter===or)&&console.warn("THREE.WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(C,i.TEXTURE_WRAP_S,ft[y.wrapS]),i.texParameteri(C,i.TEXTURE_WRAP_T,ft[y.wrapT]),(C===i.TEXTURE_3D||C===i.TEXTURE_2D_ARRAY)&&i.texParameteri(C,i.TEXTURE_WRAP_R,ft[y.wrapR]),i.texParameteri(C,i.TEXTURE_MAG_FILTER,ht[y.magFilter]),i.texParameteri(C,i.TEXTURE_MIN_FILTER,ht[y.minFilter]),y.compareFunction&&(i.texParameteri(C,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(C,i.TEXTURE_COMPARE_FUNC,_t[y.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(y.magFilter===Cn||y.minFilter!==ma&&y.minFilter!==or||y.type===yi&&t.has("OES_texture_float_linear")===!1)return;if(y.anisotropy>1||n.get(y).__currentAnisotropy){const Z=t.get("EXT_texture_filter_anisotropic");i.texParameterf(C,Z.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(y.anisotropy,s.getMaxAnisotropy())),n.get(y).__currentAnisotropy=y.anisotropy}}}function mt(C,y){let Z=!1;C.__webglInit===void 0&&(C.__webglInit=!0,y.addEventListener("dispose",P));const Q=y.source;let W=f.get(Q);W===void 0&&(W={},f.set(Q,W));const nt=$(y);if(nt!==C.__cacheKey){W[nt]===void 0&&(W[nt]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,Z=!0),W[nt].usedTimes++;const St=W[C.__cacheKey];St!==void 0&&(W[C.__cacheKey].usedTimes--,St.usedTimes===0&&w(y)),C.__cacheKey=nt,C.__webglTexture=W[nt].texture}return Z}function st(C,y,Z){let Q=i.TEXTURE_2D;(y.isDataArrayTexture||y.isCompressedArrayTexture)&&(Q=i.TEXTURE_2D_ARRAY),y.isData3DTexture&&(Q=i.TEXTURE_3D);const W=mt(C,y),nt=y.source;e.bindTexture(Q,C.__webglTexture,i.TEXTURE0+Z);const St=n.get(nt);if(nt.version!==St.__version||W===!0){e.activeTexture(i.TEXTURE0+Z);const bt=ue.getPrimaries(ue.workingColorSpace),Tt=y.colorSpace===Es?null:ue.getPrimaries(y.colorSpace),Zt=y.colorSpace===Es||bt===Tt?i.NONE:i.BROWSER_DEFAULT_WEBGL;i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,y.flipY),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,y.premultiplyAlpha),i.pixelStorei(i.UNPACK_ALIGNMENT,y.unpackAlignment),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Zt);let dt=b(y.image,!1,s.maxTextureSize);dt=fe(y,dt);const vt=r.convert(y.format,y.colorSpace),Nt=r.convert(y.type);let kt=E(y.internalFormat,vt,Nt,y.colorSpace,y.isVideoTexture);Mt(Q,y);let wt;const se=y.mipmaps,jt=y.isVideoTexture!==!0,de=St.__version===void 0||W===!0,z=nt.dataReady,xt=U(y,dt);if(y.isDepthTexture)kt=v(y.format===po,y.type),de&&(jt?e.texStorage2D(i.TEXTURE_2D,1,kt,dt.width,dt.height):e.texImage2D(i.TEXTURE_2D,0,kt,dt.width,dt.height,0,vt,Nt,null));else if(y.isDataTexture)if(se.length>0){jt&&de&&e.texStorage2D(i.TEXTURE_2D,xt,kt,se[0].width,se[0].height);for(let it=0,ot=se.length;it<ot;it++)wt=se[it],jt?z&&e.texSubImage2D(i.TEXTURE_2D,it,0,0,wt.width,wt.height,vt,Nt,wt.data):e.texImage2D(i.TEXTURE_2D,it,kt,wt.width,wt.height,0,vt,Nt,wt.data);y.generateMipmaps=!1}else jt?(de&&e.texStorage2D(i.TEXTURE_2D,xt,kt,dt.width,dt.height),z&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,dt.width,dt.height,vt,Nt,dt.data)):e.texImage2D(i.TEXTURE_2D,0,kt,dt.width,dt.height,0,vt,Nt,dt.data);else if(y.isCompressedTexture)if(y.isCompressedArrayTexture){jt&&de&&e.texStorage3D(i.TEXTURE_2D_ARRAY,xt,kt,se[0].width,se[0].height,dt.depth);for(let it=0,ot=se.length;it<ot;it++)if(wt=se[it],y.format!==wi)if(vt!==null)if(jt){if(z)if(y.layerUpdates.size>0){const At=ip(wt.width,wt.height,y.format,y.type);for(const Rt of y.layerUpdates){const Jt=wt.data.subarray(Rt*At/wt.data.BYTES_PER_ELEMENT,(Rt+1)*At/wt.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,it,0,0,Rt,wt.width,wt.height,1,vt,Jt)}y.clearLayerUpdates()}else e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,it,0,0,0,wt.width,wt.height,dt.depth,vt,wt.data)}else e.compressedTexImage3D(i.TEXTURE_2D_ARRAY,it,kt,wt.width,wt.height,dt.depth,0,wt.data,0,0);else console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else jt?z&&e.texSubImage3D(i.TEXTURE_2D_ARRAY,it,0,0,0,wt.width,wt.height,dt.depth,vt,Nt,wt.data):e.texImage3D(i.TEXTURE_2D_ARRAY,it,kt,wt.width,wt.height,dt.depth,0,vt,Nt,wt.data)}else{jt&&de&&e.texStorage2D(i.TEXTURE_2D,xt,kt,se[0].width,se[0].height);for(let it=0,ot=se.length;it<ot;it++)wt=se[it],y.format!==wi?vt!==null?jt?z&&e.compressedTexSubImage2D(i.TEXTURE_2D,it,0,0,wt.width,wt.height,vt,wt.data):e.compressedTexImage2D(i.TEXTURE_2D,it,kt,wt.width,wt.height,0,wt.data):console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):jt?z&&e.texSubImage2D(i.TEXTURE_2D,it,0,0,wt.width,wt.height,vt,Nt,wt.data):e.texImage2D(i.TEXTURE_2D,it,kt,wt.width,wt.height,0,vt,Nt,wt.data)}else if(y.isDataArrayTexture)if(jt){if(de&&e.texStorage3D(i.TEXTURE_2D_ARRAY,xt,kt,dt.width,dt.height,dt.depth),z)if(y.layerUpdates.size>0){const it=ip(dt.width,dt.height,y.format,y.type);for(const ot of y.layerUpdates){const At=dt.data.subarray(ot*it/dt.data.BYTES_PER_ELEMENT,(ot+1)*it/dt.data.BYTES_PER_ELEMENT);e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,ot,dt.width,dt.height,1,vt,Nt,At)}y.clearLayerUpdates()}else e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,dt.width,dt.height,dt.depth,vt,Nt,dt.data)}else e.texImage3D(i.TEXTURE_2D_ARRAY,0,kt,dt.width,dt.height,dt.depth,0,vt,Nt,dt.data);else if(y.isData3DTexture)jt?(de&&e.texStorage3D(i.TEXTURE_3D,xt,kt,dt.width,dt.height,dt.depth),z&&e.texSubImage3D(i.TEXTURE_3D,0,0,0,0,dt.width,dt.height,dt.depth,vt,Nt,dt.data)):e.texImage3D(i.TEXTURE_3D,0,kt,dt.width,dt.height,dt.depth,0,vt,Nt,dt.data);else if(y.isFramebufferTexture){if(de)if(jt)e.texStorage2D(i.TEXTURE_2D,xt,kt,dt.width,dt.height);else{let it=dt.width,ot=dt.height;for(let At=0;At<xt;At++)e.texImage2D(i.TEXTURE_2D,At,kt,it,ot,0,vt,Nt,null),it>>=1,ot>>=1}}else if(se.length>0){if(jt&&de){const it=Lt(se[0]);e.texStorage2D(i.TEXTURE_2D,xt,kt,it.width,it.height)}for(let it=0,ot=se.length;it<ot;it++)wt=se[it],jt?z&&e.texSubImage2D(i.TEXTURE_2D,it,0,0,vt,Nt,wt):e.texImage2D(i.TEXTURE_2D,it,kt,vt,Nt,wt);y.generateMipmaps=!1}else if(jt){if(de){const it=Lt(dt);e.texStorage2D(i.TEXTURE_2D,xt,kt,it.width,it.height)}z&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,vt,Nt,dt)}else e.texImage2D(i.TEXTURE_2D,0,kt,vt,Nt,dt);m(y)&&d(Q),St.__version=nt.version,y.onUpdate&&y.onUpdate(y)}C.__version=y.version}function lt(C,y,Z){if(y.image.length!==6)return;const Q=mt(C,y),W=y.source;e.bindTexture(i.TEXTURE_CUBE_MAP,C.__webglTexture,i.TEXTURE0+Z);const nt=n.get(W);if(W.version!==nt.__version||Q===!0){e.activeTexture(i.TEXTURE0+Z);const St=ue.getPrimaries(ue.workingColorSpace),bt=y.colorSpace===Es?null:ue.getPrimaries(y.colorSpace),Tt=y.colorSpace===Es||St===bt?i.NONE:i.BROWSER_DEFAULT_WEBGL;i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,y.flipY),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,y.premultiplyAlpha),i.pixelStorei(i.UNPACK_ALIGNMENT,y.unpackAlignment),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,Tt);const Zt=y.isCompressedTexture||y.image[0].isCompressedTexture,dt=y.image[0]&&y.image[0].isDataTexture,vt=[];for(let ot=0;ot<6;ot++)!Zt&&!dt?vt[ot]=b(y.image[ot],!0,s.maxCubemapSize):vt[ot]=dt?y.image[ot].image:y.image[ot],vt[ot]=fe(y,vt[ot]);const Nt=vt[0],kt=r.convert(y.format,y.colorSpace),wt=r.convert(y.type),se=E(y.internalFormat,kt,wt,y.colorSpace),jt=y.isVideoTexture!==!0,de=nt.__version===void 0||Q===!0,z=W.dataReady;let xt=U(y,Nt);Mt(i.TEXTURE_CUBE_MAP,y);let it;if(Zt){jt&&de&&e.texStorage2D(i.TEXTURE_CUBE_MAP,xt,se,Nt.width,Nt.height);for(let ot=0;ot<6;ot++){it=vt[ot].mipmaps;for(let At=0;At<it.length;At++){const Rt=it[At];y.format!==wi?kt!==null?jt?z&&e.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At,0,0,Rt.width,Rt.height,kt,Rt.data):e.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At,se,Rt.width,Rt.height,0,Rt.data):console.warn("THREE.WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):jt?z&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At,0,0,Rt.width,Rt.height,kt,wt,Rt.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At,se,Rt.width,Rt.height,0,kt,wt,Rt.data)}}}else{if(it=y.mipmaps,jt&&de){it.length>0&&xt++;const ot=Lt(vt[0]);e.texStorage2D(i.TEXTURE_CUBE_MAP,xt,se,ot.width,ot.height)}for(let ot=0;ot<6;ot++)if(dt){jt?z&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,0,0,0,vt[ot].width,vt[ot].height,kt,wt,vt[ot].data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,0,se,vt[ot].width,vt[ot].height,0,kt,wt,vt[ot].data);for(let At=0;At<it.length;At++){const Jt=it[At].image[ot].image;jt?z&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At+1,0,0,Jt.width,Jt.height,kt,wt,Jt.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At+1,se,Jt.width,Jt.height,0,kt,wt,Jt.data)}}else{jt?z&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,0,0,0,kt,wt,vt[ot]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,0,se,kt,wt,vt[ot]);for(let At=0;At<it.length;At++){const Rt=it[At];jt?z&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At+1,0,0,kt,wt,Rt.image[ot]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+ot,At+1,se,kt,wt,Rt.image[ot])}}}m(y)&&d(i.TEXTURE_CUBE_MAP),nt.__version=W.version,y.onUpdate&&y.onUpdate(y)}C.__version=y.version}function gt(C,y,Z,Q,W,nt){const St=r.convert(Z.format,Z.colorSpace),bt=r.convert(Z.type),Tt=E(Z.internalFormat,St,bt,Z.colorSpace),Zt=n.get(y),dt=n.get(Z);if(dt.__renderTarget=y,!Zt.__hasExternalTextures){const vt=Math.max(1,y.width>>nt),Nt=Math.max(1,y.height>>nt);W===i.TEXTURE_3D||W===i.TEXTURE_2D_ARRAY?e.texImage3D(W,nt,Tt,vt,Nt,y.depth,0,St,bt,null):e.texImage2D(W,nt,Tt,vt,Nt,0,St,bt,null)}e.bindFramebuffer(i.FRAMEBUFFER,C),ee(y)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,Q,W,dt.__webglTexture,0,Qt(y)):(W===i.TEXTURE_2D||W>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&W<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,Q,W,dt.__webglTexture,nt),e.bindFramebuffer(i.FRAMEBUFFER,null)}function at(C,y,Z){if(i.bindRenderbuffer(i.RENDERBUFFER,C),y.depthBuffer){const Q=y.depthTexture,W=Q&&Q.isDepthTexture?Q.type:null,nt=v(y.stencilBuffer,W),St=y.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,bt=Qt(y);ee(y)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,bt,nt,y.width,y.height):Z?i.renderbufferStorageMultisample(i.RENDERBUFFER,bt,nt,y.width,y.height):i.renderbufferStorage(i.RENDERBUFFER,nt,y.width,y.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,St,i.RENDERBUFFER,C)}else{const Q=y.textures;for(let W=0;W<Q.length;W++){const nt=Q[W],St=r.convert(nt.format,nt.colorSpace),bt=r.convert(nt.type),Tt=E(nt.internalFormat,St,bt,nt.colorSpace),Zt=Qt(y);Z&&ee(y)===!1?i.renderbufferStorageMultisample(i.RENDERBUFFER,Zt,Tt,y.width,y.height):ee(y)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,Zt,Tt,y.width,y.height):i.renderbufferStorage(i.RENDERBUFFER,Tt,y.width,y.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function zt(C,y){if(y&&y.isWebGLCubeRenderTarget)throw new Error("Depth Texture with cube render targets is not supported");if(e.bindFramebuffer(i.FRAMEBUFFER,C),!(y.depthTexture&&y.depthTexture.isDepthTexture))throw new Error("renderTarget.depthTexture must be an instance of THREE.DepthTexture");const Q=n.get(y.depthTexture);Q.__renderTarget=y,(!Q.__webglTexture||y.depthTexture.image.width!==y.width||y.depthTexture.image.height!==y.height)&&(y.depthTexture.image.width=y.width,y.depthTexture.image.height=y.height,y.depthTexture.needsUpdate=!0),Y(y.depthTexture,0);const W=Q.__webglTexture,nt=Qt(y);if(y.depthTexture.format===eo)ee(y)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,i.DEPTH_ATTACHMENT,i.TEXTURE_2D,W,0,nt):i.framebufferTexture2D(i.FRAMEBUFFER,i.DEPTH_ATTACHMENT,i.TEXTURE_2D,W,0);else if(y.depthTexture.format===po)ee(y)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,i.DEPTH_STENCIL_ATTACHMENT,i.TEXTURE_2D,W,0,nt):i.framebufferTexture2D(i.FRAMEBUFFER,i.DEPTH_STENCIL_ATTACHMENT,i.TEXTURE_2D,W,0);else throw new Error("Unknown depthTexture format")}function Ht(C){const y=n.get(C),Z=C.isWebGLCubeRenderTarget===!0;if(y.__boundDepthTexture!==C.depthTexture){const Q=C.depthTexture;if(y.__depthDisposeCallback&&y.__depthDisposeCallback(),Q){const W=()=>{delete y.__boundDepthTexture,delete y.__depthDisposeCallback,Q.removeEventListener("dispose",W)};Q.addEventListener("dispose",W),y.__depthDisposeCallback=W}y.__boundDepthTexture=Q}if(C.depthTexture&&!y.__autoAllocateDepthBuffer){if(Z)throw new Error("target.depthTexture not supported in Cube render targets");zt(y.__webglFramebuffer,C)}else if(Z){y.__webglDepthbuffer=[];for(let Q=0;Q<6;Q++)if(e.bindFramebuffer(i.FRAMEBUFFER,y.__webglFramebuffer[Q]),y.__webglDepthbuffer[Q]===void 0)y.__webglDepthbuffer[Q]=i.createRenderbuffer(),at(y.__webglDepthbuffer[Q],C,!1);else{const W=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,nt=y.__webglDepthbuffer[Q];i.bindRenderbuffer(i.RENDERBUFFER,nt),i.framebufferRenderbuffer(i.FRAMEBUFFER,W,i.RENDERBUFFER,nt)}}else if(e.bindFramebuffer(i.FRAMEBUFFER,y.__webglFramebuffer),y.__webglDepthbuffer===void 0)y.__webglDepthbuffer=i.createRenderbuffer(),at(y.__webglDepthbuffer,C,!1);else{const Q=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,W=y.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,W),i.framebufferRenderbuffer(i.FRAMEBUFFER,Q,i.RENDERBUFFER,W)}e.bindFramebuffer(i.FRAMEBUFFER,null)}function Ut(C,y,Z){const Q=n.get(C);y!==void 0&&gt(Q.__webglFramebuffer,C,C.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),Z!==void 0&&Ht(C)}function le(C){const y=C.texture,Z=n.get(C),Q=n.get(y);C.addEventListener("dispose",I);const W=C.textures,nt=C.isWebGLCubeRenderTarget===!0,St=W.length>1;if(St||(Q.__webglTexture===void 0&&(Q.__webglTexture=i.createTexture()),Q.__version=y.version,o.memory.textures++),nt){Z.__webglFramebuffer=[];for(let bt=0;bt<6;bt++)if(y.mipmaps&&y.mipmaps.length>0){Z.__webglFramebuffer[bt]=[];for(let Tt=0;Tt<y.mipmaps.length;Tt++)Z.__webglFramebuffer[bt][Tt]=i.createFramebuffer()}else Z.__webglFramebuffer[bt]=i.createFramebuffer()}else{if(y.mipmaps&&y.mipmaps.length>0){Z.__webglFramebuffer=[];for(let bt=0;bt<y.mipmaps.length;bt++)Z.__webglFramebuffer[bt]=i.createFramebuffer()}else Z.__webglFramebuffer=i.createFramebuffer();if(St)for(let bt=0,Tt=W.length;bt<Tt;bt++){const Zt=n.get(W[bt]);Zt.__webglTexture===void 0&&(Zt.__webglTexture=i.createTexture(),o.memory.textures++)}if(C.samples>0&&ee(C)===!1){Z.__webglMultisampledFramebuffer=i.createFramebuffer(),Z.__webglColorRenderbuffer=[],e.bindFramebuffer(i.FRAMEBUFFER,Z.__webglMultisampledFramebuffer);for(let bt=0;bt<W.length;bt++){const Tt=W[bt];Z.__webglColorRenderbuffer[bt]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,Z.__webglColorRenderbuffer[bt]);const Zt=r.convert(Tt.format,Tt.colorSpace),dt=r.convert(Tt.type),vt=E(Tt.internalFormat,Zt,dt,Tt.colorSpace,C.isXRRenderTarget===!0),Nt=Qt(C);i.renderbufferStorageMultisample(i.RENDERBUFFER,Nt,vt,C.width,C.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+bt,i.RENDERBUFFER,Z.__webglColorRenderbuffer[bt])}i.bindRenderbuffer(i.RENDERBUFFER,null),C.depthBuffer&&(Z.__webglDepthRenderbuffer=i.createRenderbuffer(),at(Z.__webglDepthRenderbuffer,C,!0)),e.bindFramebuffer(i.FRAMEBUFFER,null)}}if(nt){e.bindTexture(i.TEXTURE_CUBE_MAP,Q.__webglTexture),Mt(i.TEXTURE_CUBE_MAP,y);for(let bt=0;bt<6;bt++)if(y.mipmaps&&y.mipmaps.length>0)for(let Tt=0;Tt<y.mipmaps.length;Tt++)gt(Z.__webglFramebuffer[bt][Tt],C,y,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,Tt);else gt(Z.__webglFramebuffer[bt],C,y,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+bt,0);m(y)&&d(i.TEXTURE_CUBE_MAP),e.unbindTexture()}else if(St){for(let bt=0,Tt=W.length;bt<Tt;bt++){const Zt=W[bt],dt=n.get(Zt);e.bindTexture(i.TEXTURE_2D,dt.__webglTexture),Mt(i.TEXTURE_2D,Zt),gt(Z.__webglFramebuffer,C,Zt,i.COLOR_ATTACHMENT0+bt,i.TEXTURE_2D,0),m(Zt)&&d(i.TEXTURE_2D)}e.unbindTexture()}else{let bt=i.TEXTURE_2D;if((C.isWebGL3DRenderTarget||C.isWebGLArrayRenderTarget)&&(bt=C.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(bt,Q.__webglTexture),Mt(bt,y),y.mipmaps&&y.mipmaps.length>0)for(let Tt=0;Tt<y.mipmaps.length;Tt++)gt(Z.__webglFramebuffer[Tt],C,y,i.COLOR_ATTACHMENT0,bt,Tt);else gt(Z.__webglFramebuffer,C,y,i.COLOR_ATTACHMENT0,bt,0);m(y)&&d(bt),e.unbindTexture()}C.depthBuffer&&Ht(C)}function Kt(C){const y=C.textures;for(let Z=0,Q=y.length;Z<Q;Z++){const W=y[Z];if(m(W)){const nt=S(C),St=n.get(W).__webglTexture;e.bindTexture(nt,St),d(nt),e.unbindTexture()}}}const ce=[],V=[];function tn(C){if(C.samples>0){if(ee(C)===!1){const y=C.textures,Z=C.width,Q=C.height;let W=i.COLOR_BUFFER_BIT;const nt=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,St=n.get(C),bt=y.length>1;if(bt)for(let Tt=0;Tt<y.length;Tt++)e.bindFramebuffer(i.FRAMEBUFFER,St.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+Tt,i.RENDERBUFFER,null),e.bindFramebuffer(i.FRAMEBUFFER,St.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+Tt,i.TEXTURE_2D,null,0);e.bindFramebuffer(i.READ_FRAMEBUFFER,St.__webglMultisampledFramebuffer),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,St.__webglFramebuffer);for(let Tt=0;Tt<y.length;Tt++){if(C.resolveDepthBuffer&&(C.depthBuffer&&(W|=i.DEPTH_BUFFER_BIT),C.stencilBuffer&&C.resolveStencilBuffer&&(W|=i.STENCIL_BUFFER_BIT)),bt){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,St.__webglColorRenderbuffer[Tt]);const Zt=n.get(y[Tt]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,Zt,0)}i.blitFramebuffer(0,0,Z,Q,0,0,Z,Q,W,i.NEAREST),l===!0&&(ce.length=0,V.length=0,ce.push(i.COLOR_ATTACHMENT0+Tt),C.depthBuffer&&C.resolveDepthBuffer===!1&&(ce.push(nt),V.push(nt),i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,V)),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,ce))}if(e.bindFramebuffer(i.READ_FRAMEBUFFER,null),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),bt)for(let Tt=0;Tt<y.length;Tt++){e.bindFramebuffer(i.FRAMEBUFFER,St.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+Tt,i.RENDERBUFFER,St.__webglColorRenderbuffer[Tt]);const Zt=n.get(y[Tt]).__webglTexture;e.bindFramebuffer(i.FRAMEBUFFER,St.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+Tt,i.TEXTURE_2D,Zt,0)}e.bindFramebuffer(i.DRAW_FRAMEBUFFER,St.__webglMultisampledFramebuffer)}else if(C.depthBuffer&&C.resolveDepthBuffer===!1&&l){const y=C.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[y])}}}function Qt(C){return Math.min(s.maxSamples,C.samples)}function ee(C){const y=n.get(C);return C.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&y.__useRenderToTexture!==!1}function Gt(C){const y=o.render.frame;h.get(C)!==y&&(h.set(C,y),C.update())}function fe(C,y){const Z=C.colorSpace,Q=C.format,W=C.type;return C.isCompressedTexture===!0||C.isVideoTexture===!0||Z!==pr&&Z!==Es&&(ue.getTransfer(Z)===Te?(Q!==wi||W!==ls)&&console.warn("THREE.WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):console.error("THREE.WebGLTextures: Unsupported texture color space:",Z)),y}function Lt(C){return typeof HTMLImageElement<"u"&&C instanceof HTMLImageElement?(c.width=C.naturalWidth||C.width,c.height=C.naturalHeight||C.height):typeof VideoFrame<"u"&&C instanceof VideoFrame?(c.width=C.displayWidth,c.height=C.displayHeight):(c.width=C.width,c.height=C.height),c}this.allocateTextureUnit=O,this.resetTextureUnits=G,this.setTexture2D=Y,this.setTexture2DArray=J,this.setTexture3D=K,this.setTextureCube=et,this.rebindTextures=Ut,this.setupRenderTarget=le,this.updateRenderTargetMipmap=Kt,this.updateMultisampleRenderTarget=tn,this.setupDepthRenderbuffer=Ht,this.setupFrameBufferTexture=gt,this.useMultisampledRTT=ee}function tE(i,t){function e(n,s=Es){let r;const o=ue.getTransfer(s);if(n===ls)return i.UNSIGNED_BYTE;if(n===Tu)return i.UNSIGNED_SHORT_4_4_4_4;if(n===Au)return i.UNSIGNED_SHORT_5_5_5_1;if(n===km)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===Om)return i.BYTE;if(n===Eu)return i.SHORT;if(n===Ko)return i.UNSIGNED_SHORT;if(n===Nl)return i.INT;if(n===ur)return i.UNSIGNED_INT;if(n===yi)return i.FLOAT;if(n===ta)return i.HALF_FLOAT;if(n===Bm)return i.ALPHA;if(n===zm)return i.RGB;if(n===wi)return i.RGBA;if(n===Vm)return i.LUMINANCE;if(n===Hm)return i.LUMINANCE_ALPHA;if(n===eo)return i.DEPTH_COMPONENT;if(n===po)return i.DEPTH_STENCIL;if(n===Ru)return i.RED;if(n===Pu)return i.RED_INTEGER;if(n===Gm)return i.RG;if(n===Cu)return i.RG_INTEGER;if(n===Ol)return i.RGBA_INTEGER;if(n===qa||n===ja||n===$a||n===Za)if(o===Te)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===qa)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===ja)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===$a)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===Za)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===qa)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===ja)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===$a)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===Za)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===Rh||n===Ph||n===Ch||n===Lh)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===Rh)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===Ph)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===Ch)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Lh)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Ih||n===Fh||n===Dh)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Ih||n===Fh)return o===Te?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===Dh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC}else return null;if(n===Uh||n===Nh||n===Oh||n===kh||n===Bh||n===zh||n===Vh||n===Hh||n===Gh||n===Wh||n===Xh||n===Yh||n===qh||n===jh)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(n===Uh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Nh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===Oh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===kh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Bh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===zh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===Vh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===Hh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===Gh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Wh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Xh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===Yh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===qh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===jh)return o===Te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===Ka||n===$h||n===Zh)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(n===Ka)return o===Te?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===$h)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===Zh)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===Wm||n===Kh||n===Jh||n===Qh)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(n===Ka)return r.COMPRESSED_RED_RGTC1_EXT;if(n===Kh)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===Jh)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===Qh)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===fo?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:e}}class eE extends ci{constructor(t=[]){super(),this.isArrayCamera=!0,this.cameras=t}}class Ts extends vn{constructor(){super(),this.isGroup=!0,this.type="Group"}}const nE={type:"move"};class Bc{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Ts,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Ts,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new D,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new D),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Ts,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new D,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new D),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){const e=this._hand;if(e)for(const n of t.hand.values())this._getHandJoint(e,n)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,n){let s=null,r=null,o=null;const a=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){o=!0;for(const b of t.hand.values()){const m=e.getJointPose(b,n),d=this._getHandJoint(c,b);m!==null&&(d.matrix.fromArray(m.transform.matrix),d.matrix.decompose(d.position,d.rotation,d.scale),d.matrixWorldNeedsUpdate=!0,d.jointRadius=m.radius),d.visible=m!==null}const h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],f=h.position.distanceTo(u.position),p=.02,_=.005;c.inputState.pinching&&f>p+_?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&f<=p-_&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.rotation,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1));a!==null&&(s=e.getPose(t.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.rotation,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(nE)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){const n=new Ts;n.matrixAutoUpdate=!1,n.visible=!1,t.joints[e.jointName]=n,t.add(n)}return t.joints[e.jointName]}}const iE=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,sE=`
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

}`;class rE{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e,n){if(this.texture===null){const s=new kn,r=t.properties.get(s);r.__webglTexture=e.texture,(e.depthNear!=n.depthNear||e.depthFar!=n.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=s}}getMesh(t){if(this.texture!==null&&this.mesh===null){const e=t.cameras[0].viewport,n=new cs({vertexShader:iE,fragmentShader:sE,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new an(new zl(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}}class oE extends mr{constructor(t,e){super();const n=this;let s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,f=null,p=null,_=null;const b=new rE,m=e.getContextAttributes();let d=null,S=null;const E=[],v=[],U=new qt;let P=null;const I=new ci;I.viewport=new ze;const F=new ci;F.viewport=new ze;const w=[I,F],x=new eE;let R=null,G=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(st){let lt=E[st];return lt===void 0&&(lt=new Bc,E[st]=lt),lt.getTargetRaySpace()},this.getControllerGrip=function(st){let lt=E[st];return lt===void 0&&(lt=new Bc,E[st]=lt),lt.getGripSpace()},this.getHand=function(st){let lt=E[st];return lt===void 0&&(lt=new Bc,E[st]=lt),lt.getHandSpace()};function O(st){const lt=v.indexOf(st.inputSource);if(lt===-1)return;const gt=E[lt];gt!==void 0&&(gt.update(st.inputSource,st.frame,c||o),gt.dispatchEvent({type:st.type,data:st.inputSource}))}function $(){s.removeEventListener("select",O),s.removeEventListener("selectstart",O),s.removeEventListener("selectend",O),s.removeEventListener("squeeze",O),s.removeEventListener("squeezestart",O),s.removeEventListener("squeezeend",O),s.removeEventListener("end",$),s.removeEventListener("inputsourceschange",Y);for(let st=0;st<E.length;st++){const lt=v[st];lt!==null&&(v[st]=null,E[st].disconnect(lt))}R=null,G=null,b.reset(),t.setRenderTarget(d),p=null,f=null,u=null,s=null,S=null,mt.stop(),n.isPresenting=!1,t.setPixelRatio(P),t.setSize(U.width,U.height,!1),n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(st){r=st,n.isPresenting===!0&&console.warn("THREE.WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(st){a=st,n.isPresenting===!0&&console.warn("THREE.WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(st){c=st},this.getBaseLayer=function(){return f!==null?f:p},this.getBinding=function(){return u},this.getFrame=function(){return _},this.getSession=function(){return s},this.setSession=async function(st){if(s=st,s!==null){if(d=t.getRenderTarget(),s.addEventListener("select",O),s.addEventListener("selectstart",O),s.addEventListener("selectend",O),s.addEventListener("squeeze",O),s.addEventListener("squeezestart",O),s.addEventListener("squeezeend",O),s.addEventListener("end",$),s.addEventListener("inputsourceschange",Y),m.xrCompatible!==!0&&await e.makeXRCompatible(),P=t.getPixelRatio(),t.getSize(U),s.renderState.layers===void 0){const lt={antialias:m.antialias,alpha:!0,depth:m.depth,stencil:m.stencil,framebufferScaleFactor:r};p=new XRWebGLLayer(s,e,lt),s.updateRenderState({baseLayer:p}),t.setPixelRatio(1),t.setSize(p.framebufferWidth,p.framebufferHeight,!1),S=new Cs(p.framebufferWidth,p.framebufferHeight,{format:wi,type:ls,colorSpace:t.outputColorSpace,stencilBuffer:m.stencil})}else{let lt=null,gt=null,at=null;m.depth&&(at=m.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,lt=m.stencil?po:eo,gt=m.stencil?fo:ur);const zt={colorFormat:e.RGBA8,depthFormat:at,scaleFactor:r};u=new XRWebGLBinding(s,e),f=u.createProjectionLayer(zt),s.updateRenderState({layers:[f]}),t.setPixelRatio(1),t.setSize(f.textureWidth,f.textureHeight,!1),S=new Cs(f.textureWidth,f.textureHeight,{format:wi,type:ls,depthTexture:new s_(f.textureWidth,f.textureHeight,gt,void 0,void 0,void 0,void 0,void 0,void 0,lt),stencilBuffer:m.stencil,colorSpace:t.outputColorSpace,samples:m.antialias?4:0,resolveDepthBuffer:f.ignoreDepthValues===!1})}S.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),mt.setContext(s),mt.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return b.getDepthTexture()};function Y(st){for(let lt=0;lt<st.removed.length;lt++){const gt=st.removed[lt],at=v.indexOf(gt);at>=0&&(v[at]=null,E[at].disconnect(gt))}for(let lt=0;lt<st.added.length;lt++){const gt=st.added[lt];let at=v.indexOf(gt);if(at===-1){for(let Ht=0;Ht<E.length;Ht++)if(Ht>=v.length){v.push(gt),at=Ht;break}else if(v[Ht]===null){v[Ht]=gt,at=Ht;break}if(at===-1)break}const zt=E[at];zt&&zt.connect(gt)}}const J=new D,K=new D;function et(st,lt,gt){J.setFromMatrixPosition(lt.matrixWorld),K.setFromMatrixPosition(gt.matrixWorld);const at=J.distanceTo(K),zt=lt.projectionMatrix.elements,Ht=gt.projectionMatrix.elements,Ut=zt[14]/(zt[10]-1),le=zt[14]/(zt[10]+1),Kt=(zt[9]+1)/zt[5],ce=(zt[9]-1)/zt[5],V=(zt[8]-1)/zt[0],tn=(Ht[8]+1)/Ht[0],Qt=Ut*V,ee=Ut*tn,Gt=at/(-V+tn),fe=Gt*-V;if(lt.matrixWorld.decompose(st.position,st.quaternion,st.scale),st.translateX(fe),st.translateZ(Gt),st.matrixWorld.compose(st.position,st.quaternion,st.scale),st.matrixWorldInverse.copy(st.matrixWorld).invert(),zt[10]===-1)st.projectionMatrix.copy(lt.projectionMatrix),st.projectionMatrixInverse.copy(lt.projectionMatrixInverse);else{const Lt=Ut+Gt,C=le+Gt,y=Qt-fe,Z=ee+(at-fe),Q=Kt*le/C*Lt,W=ce*le/C*Lt;st.projectionMatrix.makePerspective(y,Z,Q,W,Lt,C),st.projectionMatrixInverse.copy(st.projectionMatrix).invert()}}function ft(st,lt){lt===null?st.matrixWorld.copy(st.matrix):st.matrixWorld.multiplyMatrices(lt.matrixWorld,st.matrix),st.matrixWorldInverse.copy(st.matrixWorld).invert()}this.updateCamera=function(st){if(s===null)return;let lt=st.near,gt=st.far;b.texture!==null&&(b.depthNear>0&&(lt=b.depthNear),b.depthFar>0&&(gt=b.depthFar)),x.near=F.near=I.near=lt,x.far=F.far=I.far=gt,(R!==x.near||G!==x.far)&&(s.updateRenderState({depthNear:x.near,depthFar:x.far}),R=x.near,G=x.far),I.layers.mask=st.layers.mask|2,F.layers.mask=st.layers.mask|4,x.layers.mask=I.layers.mask|F.layers.mask;const at=st.parent,zt=x.cameras;ft(x,at);for(let Ht=0;Ht<zt.length;Ht++)ft(zt[Ht],at);zt.length===2?et(x,I,F):x.projectionMatrix.copy(I.projectionMatrix),ht(st,x,at)};function ht(st,lt,gt){gt===null?st.matrix.copy(lt.matrixWorld):(st.matrix.copy(gt.matrixWorld),st.matrix.invert(),st.matrix.multiply(lt.matrixWorld)),st.matrix.decompose(st.position,st.quaternion,st.scale),st.updateMatrixWorld(!0),st.projectionMatrix.copy(lt.projectionMatrix),st.projectionMatrixInverse.copy(lt.projectionMatrixInverse),st.isPerspectiveCamera&&(st.fov=tu*2*Math.atan(1/st.projectionMatrix.elements[5]),st.zoom=1)}this.getCamera=function(){return x},this.getFoveation=function(){if(!(f===null&&p===null))return l},this.setFoveation=function(st){l=st,f!==null&&(f.fixedFoveation=st),p!==null&&p.fixedFoveation!==void 0&&(p.fixedFoveation=st)},this.hasDepthSensing=function(){return b.texture!==null},this.getDepthSensingMesh=function(){return b.getMesh(x)};let _t=null;function Mt(st,lt){if(h=lt.getViewerPose(c||o),_=lt,h!==null){const gt=h.views;p!==null&&(t.setRenderTargetFramebuffer(S,p.framebuffer),t.setRenderTarget(S));let at=!1;gt.length!==x.cameras.length&&(x.cameras.length=0,at=!0);for(let Ht=0;Ht<gt.length;Ht++){const Ut=gt[Ht];let le=null;if(p!==null)le=p.getViewport(Ut);else{const ce=u.getViewSubImage(f,Ut);le=ce.viewport,Ht===0&&(t.setRenderTargetTextures(S,ce.colorTexture,f.ignoreDepthValues?void 0:ce.depthStencilTexture),t.setRenderTarget(S))}let Kt=w[Ht];Kt===void 0&&(Kt=new ci,Kt.layers.enable(Ht),Kt.viewport=new ze,w[Ht]=Kt),Kt.matrix.fromArray(Ut.transform.matrix),Kt.matrix.decompose(Kt.position,Kt.quaternion,Kt.scale),Kt.projectionMatrix.fromArray(Ut.projectionMatrix),Kt.projectionMatrixInverse.copy(Kt.projectionMatrix).invert(),Kt.viewport.set(le.x,le.y,le.width,le.height),Ht===0&&(x.matrix.copy(Kt.matrix),x.matrix.decompose(x.position,x.quaternion,x.scale)),at===!0&&x.cameras.push(Kt)}const zt=s.enabledFeatures;if(zt&&zt.includes("depth-sensing")){const Ht=u.getDepthInformation(gt[0]);Ht&&Ht.isValid&&Ht.texture&&b.init(t,Ht,s.renderState)}}for(let gt=0;gt<E.length;gt++){const at=v[gt],zt=E[gt];at!==null&&zt!==void 0&&zt.update(at,lt,c||o)}_t&&_t(st,lt),lt.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:lt}),_=null}const mt=new n_;mt.setAnimationLoop(Mt),this.setAnimationLoop=function(st){_t=st},this.dispose=function(){}}}const Ys=new Ei,aE=new Re;function lE(i,t){function e(m,d){m.matrixAutoUpdate===!0&&m.updateMatrix(),d.value.copy(m.matrix)}function n(m,d){d.color.getRGB(m.fogColor.value,t_(i)),d.isFog?(m.fogNear.value=d.near,m.fogFar.value=d.far):d.isFogExp2&&(m.fogDensity.value=d.density)}function s(m,d,S,E,v){d.isMeshBasicMaterial||d.isMeshLambertMaterial?r(m,d):d.isMeshToonMaterial?(r(m,d),u(m,d)):d.isMeshPhongMaterial?(r(m,d),h(m,d)):d.isMeshStandardMaterial?(r(m,d),f(m,d),d.isMeshPhysicalMaterial&&p(m,d,v)):d.isMeshMatcapMaterial?(r(m,d),_(m,d)):d.isMeshDepthMaterial?r(m,d):d.isMeshDistanceMaterial?(r(m,d),b(m,d)):d.isMeshNormalMaterial?r(m,d):d.isLineBasicMaterial?(o(m,d),d.isLineDashedMaterial&&a(m,d)):d.isPointsMaterial?l(m,d,S,E):d.isSpriteMaterial?c(m,d):d.isShadowMaterial?(m.color.value.copy(d.color),m.opacity.value=d.opacity):d.isShaderMaterial&&(d.uniformsNeedUpdate=!1)}function r(m,d){m.opacity.value=d.opacity,d.color&&m.diffuse.value.copy(d.color),d.emissive&&m.emissive.value.copy(d.emissive).multiplyScalar(d.emissiveIntensity),d.map&&(m.map.value=d.map,e(d.map,m.mapTransform)),d.alphaMap&&(m.alphaMap.value=d.alphaMap,e(d.alphaMap,m.alphaMapTransform)),d.bumpMap&&(m.bumpMap.value=d.bumpMap,e(d.bumpMap,m.bumpMapTransform),m.bumpScale.value=d.bumpScale,d.side===Gn&&(m.bumpScale.value*=-1)),d.normalMap&&(m.normalMap.value=d.normalMap,e(d.normalMap,m.normalMapTransform),m.normalScale.value.copy(d.normalScale),d.side===Gn&&m.normalScale.value.negate()),d.displacementMap&&(m.displacementMap.value=d.displacementMap,e(d.displacementMap,m.displacementMapTransform),m.displacementScale.value=d.displacementScale,m.displacementBias.value=d.displacementBias),d.emissiveMap&&(m.emissiveMap.value=d.emissiveMap,e(d.emissiveMap,m.emissiveMapTransform)),d.specularMap&&(m.specularMap.value=d.specularMap,e(d.specularMap,m.specularMapTransform)),d.alphaTest>0&&(m.alphaTest.value=d.alphaTest);const S=t.get(d),E=S.envMap,v=S.envMapRotation;E&&(m.envMap.value=E,Ys.copy(v),Ys.x*=-1,Ys.y*=-1,Ys.z*=-1,E.isCubeTexture&&E.isRenderTargetTexture===!1&&(Ys.y*=-1,Ys.z*=-1),m.envMapRotation.value.setFromMatrix4(aE.makeRotationFromEuler(Ys)),m.flipEnvMap.value=E.isCubeTexture&&E.isRenderTargetTexture===!1?-1:1,m.reflectivity.value=d.reflectivity,m.ior.value=d.ior,m.refractionRatio.value=d.refractionRatio),d.lightMap&&(m.lightMap.value=d.lightMap,m.lightMapIntensity.value=d.lightMapIntensity,e(d.lightMap,m.lightMapTransform)),d.aoMap&&(m.aoMap.value=d.aoMap,m.aoMapIntensity.value=d.aoMapIntensity,e(d.aoMap,m.aoMapTransform))}function o(m,d){m.diffuse.value.copy(d.color),m.opacity.value=d.opacity,d.map&&(m.map.value=d.map,e(d.map,m.mapTransform))}function a(m,d){m.dashSize.value=d.dashSize,m.totalSize.value=d.dashSize+d.gapSize,m.scale.value=d.scale}function l(m,d,S,E){m.diffuse.value.copy(d.color),m.opacity.value=d.opacity,m.size.value=d.size*S,m.scale.value=E*.5,d.map&&(m.map.value=d.map,e(d.map,m.uvTransform)),d.alphaMap&&(m.alphaMap.value=d.alphaMap,e(d.alphaMap,m.alphaMapTransform)),d.alphaTest>0&&(m.alphaTest.value=d.alphaTest)}function c(m,d){m.diffuse.value.copy(d.color),m.opacity.value=d.opacity,m.rotation.value=d.rotation,d.map&&(m.map.value=d.map,e(d.map,m.mapTransform)),d.alphaMap&&(m.alphaMap.value=d.alphaMap,e(d.alphaMap,m.alphaMapTransform)),d.alphaTest>0&&(m.alphaTest.value=d.alphaTest)}function h(m,d){m.specular.value.copy(d.specular),m.shininess.value=Math.max(d.shininess,1e-4)}function u(m,d){d.gradientMap&&(m.gradientMap.value=d.gradientMap)}function f(m,d){m.metalness.value=d.metalness,d.metalnessMap&&(m.metalnessMap.value=d.metalnessMap,e(d.metalnessMap,m.metalnessMapTransform)),m.roughness.value=d.roughness,d.roughnessMap&&(m.roughnessMap.value=d.roughnessMap,e(d.roughnessMap,m.roughnessMapTransform)),d.envMap&&(m.envMapIntensity.value=d.envMapIntensity)}function p(m,d,S){m.ior.value=d.ior,d.sheen>0&&(m.sheenColor.value.copy(d.sheenColor).multiplyScalar(d.sheen),m.sheenRoughness.value=d.sheenRoughness,d.sheenColorMap&&(m.sheenColorMap.value=d.sheenColorMap,e(d.sheenColorMap,m.sheenColorMapTransform)),d.sheenRoughnessMap&&(m.sheenRoughnessMap.value=d.sheenRoughnessMap,e(d.sheenRoughnessMap,m.sheenRoughnessMapTransform))),d.clearcoat>0&&(m.clearcoat.value=d.clearcoat,m.clearcoatRoughness.value=d.clearcoatRoughness,d.clearcoatMap&&(m.clearcoatMap.value=d.clearcoatMap,e(d.clearcoatMap,m.clearcoatMapTransform)),d.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=d.clearcoatRoughnessMap,e(d.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),d.clearcoatNormalMap&&(m.clearcoatNormalMap.value=d.clearcoatNormalMap,e(d.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(d.clearcoatNormalScale),d.side===Gn&&m.clearcoatNormalScale.value.negate())),d.dispersion>0&&(m.dispersion.value=d.dispersion),d.iridescence>0&&(m.iridescence.value=d.iridescence,m.iridescenceIOR.value=d.iridescenceIOR,m.iridescenceThicknessMinimum.value=d.iridescenceThicknessRange[0],m.iridescenceThicknessMaximum.value=d.iridescenceThicknessRange[1],d.iridescenceMap&&(m.iridescenceMap.value=d.iridescenceMap,e(d.iridescenceMap,m.iridescenceMapTransform)),d.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=d.iridescenceThicknessMap,e(d.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),d.transmission>0&&(m.transmission.value=d.transmission,m.transmissionSamplerMap.value=S.texture,m.transmissionSamplerSize.value.set(S.width,S.height),d.transmissionMap&&(m.transmissionMap.value=d.transmissionMap,e(d.transmissionMap,m.transmissionMapTransform)),m.thickness.value=d.thickness,d.thicknessMap&&(m.thicknessMap.value=d.thicknessMap,e(d.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=d.attenuationDistance,m.attenuationColor.value.copy(d.attenuationColor)),d.anisotropy>0&&(m.anisotropyVector.value.set(d.anisotropy*Math.cos(d.anisotropyRotation),d.anisotropy*Math.sin(d.anisotropyRotation)),d.anisotropyMap&&(m.anisotropyMap.value=d.anisotropyMap,e(d.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=d.specularIntensity,m.specularColor.value.copy(d.specularColor),d.specularColorMap&&(m.specularColorMap.value=d.specularColorMap,e(d.specularColorMap,m.specularColorMapTransform)),d.specularIntensityMap&&(m.specularIntensityMap.value=d.specularIntensityMap,e(d.specularIntensityMap,m.specularIntensityMapTransform))}function _(m,d){d.matcap&&(m.matcap.value=d.matcap)}function b(m,d){const S=t.get(d).light;m.referencePosition.value.setFromMatrixPosition(S.matrixWorld),m.nearDistance.value=S.shadow.camera.near,m.farDistance.value=S.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function cE(i,t,e,n){let s={},r={},o=[];const a=i.getParameter(i.MAX_UNIFORM_BUFFER_BINDINGS);function l(S,E){const v=E.program;n.uniformBlockBinding(S,v)}function c(S,E){let v=s[S.id];v===void 0&&(_(S),v=h(S),s[S.id]=v,S.addEventListener("dispose",m));const U=E.program;n.updateUBOMapping(S,U);const P=t.render.frame;r[S.id]!==P&&(f(S),r[S.id]=P)}function h(S){const E=u();S.__bindingPointIndex=E;const v=i.createBuffer(),U=S.__size,P=S.usage;return i.bindBuffer(i.UNIFORM_BUFFER,v),i.bufferData(i.UNIFORM_BUFFER,U,P),i.bindBuffer(i.UNIFORM_BUFFER,null),i.bindBufferBase(i.UNIFORM_BUFFER,E,v),v}function u(){for(let S=0;S<a;S++)if(o.indexOf(S)===-1)return o.push(S),S;return console.error("THREE.WebGLRenderer: Maximum number of simultaneously usable uniforms groups reached."),0}function f(S){const E=s[S.id],v=S.uniforms,U=S.__cache;i.bindBuffer(i.UNIFORM_BUFFER,E);for(let P=0,I=v.length;P<I;P++){const F=Array.isArray(v[P])?v[P]:[v[P]];for(let w=0,x=F.length;w<x;w++){const R=F[w];if(p(R,P,w,U)===!0){const G=R.__offset,O=Array.isArray(R.value)?R.value:[R.value];let $=0;for(let Y=0;Y<O.length;Y++){const J=O[Y],K=b(J);typeof J=="number"||typeof J=="boolean"?(R.__data[0]=J,i.bufferSubData(i.UNIFORM_BUFFER,G+$,R.__data)):J.isMatrix3?(R.__data[0]=J.elements[0],R.__data[1]=J.elements[1],R.__data[2]=J.elements[2],R.__data[3]=0,R.__data[4]=J.elements[3],R.__data[5]=J.elements[4],R.__data[6]=J.elements[5],R.__data[7]=0,R.__data[8]=J.elements[6],R.__data[9]=J.elements[7],R.__data[10]=J.elements[8],R.__data[11]=0):(J.toArray(R.__data,$),$+=K.storage/Float32Array.BYTES_PER_ELEMENT)}i.bufferSubData(i.UNIFORM_BUFFER,G,R.__data)}}}i.bindBuffer(i.UNIFORM_BUFFER,null)}function p(S,E,v,U){const P=S.value,I=E+"_"+v;if(U[I]===void 0)return typeof P=="number"||typeof P=="boolean"?U[I]=P:U[I]=P.clone(),!0;{const F=U[I];if(typeof P=="number"||typeof P=="boolean"){if(F!==P)return U[I]=P,!0}else if(F.equals(P)===!1)return F.copy(P),!0}return!1}function _(S){const E=S.uniforms;let v=0;const U=16;for(let I=0,F=E.length;I<F;I++){const w=Array.isArray(E[I])?E[I]:[E[I]];for(let x=0,R=w.length;x<R;x++){const G=w[x],O=Array.isArray(G.value)?G.value:[G.value];for(let $=0,Y=O.length;$<Y;$++){const J=O[$],K=b(J),et=v%U,ft=et%K.boundary,ht=et+ft;v+=ft,ht!==0&&U-ht<K.storage&&(v+=U-ht),G.__data=new Float32Array(K.storage/Float32Array.BYTES_PER_ELEMENT),G.__offset=v,v+=K.storage}}}const P=v%U;return P>0&&(v+=U-P),S.__size=v,S.__cache={},this}function b(S){const E={boundary:0,storage:0};return typeof S=="number"||typeof S=="boolean"?(E.boundary=4,E.storage=4):S.isVector2?(E.boundary=8,E.storage=8):S.isVector3||S.isColor?(E.boundary=16,E.storage=12):S.isVector4?(E.boundary=16,E.storage=16):S.isMatrix3?(E.boundary=48,E.storage=48):S.isMatrix4?(E.boundary=64,E.storage=64):S.isTexture?console.warn("THREE.WebGLRenderer: Texture samplers can not be part of an uniforms group."):console.warn("THREE.WebGLRenderer: Unsupported uniform value type.",S),E}function m(S){const E=S.target;E.removeEventListener("dispose",m);const v=o.indexOf(E.__bindingPointIndex);o.splice(v,1),i.deleteBuffer(s[E.id]),delete s[E.id],delete r[E.id]}function d(){for(const S in s)i.deleteBuffer(s[S]);o=[],s={},r={}}return{bind:l,update:c,dispose:d}}class hE{constructor(t={}){const{canvas:e=Jv(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reverseDepthBuffer:f=!1}=t;this.isWebGLRenderer=!0;let p;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");p=n.getContextAttributes().alpha}else p=o;const _=new Uint32Array(4),b=new Int32Array(4);let m=null,d=null;const S=[],E=[];this.domElement=e,this.debug={checkShaderErrors:!0,onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this._outputColorSpace=ai,this.toneMapping=As,this.toneMappingExposure=1;const v=this;let U=!1,P=0,I=0,F=null,w=-1,x=null;const R=new ze,G=new ze;let O=null;const $=new ie(0);let Y=0,J=e.width,K=e.height,et=1,ft=null,ht=null;const _t=new ze(0,0,J,K),Mt=new ze(0,0,J,K);let mt=!1;const st=new Fu;let lt=!1,gt=!1;const at=new Re,zt=new Re,Ht=new D,Ut=new ze,le={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0};let Kt=!1;function ce(){return F===null?et:1}let V=n;function tn(T,B){return e.getContext(T,B)}try{const T={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${wu}`),e.addEventListener("webglcontextlost",ot,!1),e.addEventListener("webglcontextrestored",At,!1),e.addEventListener("webglcontextcreationerror",Rt,!1),V===null){const B="webgl2";if(V=tn(B,T),V===null)throw tn(B)?new Error("Error creating WebGL context with your selected attributes."):new Error("Error creating WebGL context.")}}catch(T){throw console.error("THREE.WebGLRenderer: "+T.message),T}let Qt,ee,Gt,fe,Lt,C,y,Z,Q,W,nt,St,bt,Tt,Zt,dt,vt,Nt,kt,wt,se,jt,de,z;function xt(){Qt=new my(V),Qt.init(),jt=new tE(V,Qt),ee=new cy(V,Qt,t,jt),Gt=new Kw(V,Qt),ee.reverseDepthBuffer&&f&&Gt.buffers.depth.setReversed(!0),fe=new by(V),Lt=new Nw,C=new Qw(V,Qt,Gt,Lt,ee,jt,fe),y=new uy(v),Z=new py(v),Q=new Ex(V),de=new ay(V,Q),W=new _y(V,Q,fe,de),nt=new xy(V,W,Q,fe),kt=new vy(V,ee,C),dt=new hy(Lt),St=new Uw(v,y,Z,Qt,ee,de,dt),bt=new lE(v,Lt),Tt=new kw,Zt=new Ww(Qt),Nt=new oy(v,y,Z,Gt,nt,p,l),vt=new $w(v,nt,ee),z=new cE(V,fe,ee,Gt),wt=new ly(V,Qt,fe),se=new gy(V,Qt,fe),fe.programs=St.programs,v.capabilities=ee,v.extensions=Qt,v.properties=Lt,v.renderLists=Tt,v.shadowMap=vt,v.state=Gt,v.info=fe}xt();const it=new oE(v,V);this.xr=it,this.getContext=function(){return V},this.getContextAttributes=function(){return V.getContextAttributes()},this.forceContextLoss=function(){const T=Qt.get("WEBGL_lose_context");T&&T.loseContext()},this.forceContextRestore=function(){const T=Qt.get("WEBGL_lose_context");T&&T.restoreContext()},this.getPixelRatio=function(){return et},this.setPixelRatio=function(T){T!==void 0&&(et=T,this.setSize(J,K,!1))},this.getSize=function(T){return T.set(J,K)},this.setSize=function(T,B,X=!0){if(it.isPresenting){console.warn("THREE.WebGLRenderer: Can't change size while VR device is presenting.");return}J=T,K=B,e.width=Math.floor(T*et),e.height=Math.floor(B*et),X===!0&&(e.style.width=T+"px",e.style.height=B+"px"),this.setViewport(0,0,T,B)},this.getDrawingBufferSize=function(T){return T.set(J*et,K*et).floor()},this.setDrawingBufferSize=function(T,B,X){J=T,K=B,et=X,e.width=Math.floor(T*X),e.height=Math.floor(B*X),this.setViewport(0,0,T,B)},this.getCurrentViewport=function(T){return T.copy(R)},this.getViewport=function(T){return T.copy(_t)},this.setViewport=function(T,B,X,q){T.isVector4?_t.set(T.x,T.y,T.z,T.w):_t.set(T,B,X,q),Gt.viewport(R.copy(_t).multiplyScalar(et).round())},this.getScissor=function(T){return T.copy(Mt)},this.setScissor=function(T,B,X,q){T.isVector4?Mt.set(T.x,T.y,T.z,T.w):Mt.set(T,B,X,q),Gt.scissor(G.copy(Mt).multiplyScalar(et).round())},this.getScissorTest=function(){return mt},this.setScissorTest=function(T){Gt.setScissorTest(mt=T)},this.setOpaqueSort=function(T){ft=T},this.setTransparentSort=function(T){ht=T},this.getClearColor=function(T){return T.copy(Nt.getClearColor())},this.setClearColor=function(){Nt.setClearColor.apply(Nt,arguments)},this.getClearAlpha=function(){return Nt.getClearAlpha()},this.setClearAlpha=function(){Nt.setClearAlpha.apply(Nt,arguments)},this.clear=function(T=!0,B=!0,X=!0){let q=0;if(T){let H=!1;if(F!==null){const ut=F.texture.format;H=ut===Ol||ut===Cu||ut===Pu}if(H){const ut=F.texture.type,yt=ut===ls||ut===ur||ut===Ko||ut===fo||ut===Tu||ut===Au,Ot=Nt.getClearColor(),Ft=Nt.getClearAlpha(),Wt=Ot.r,Yt=Ot.g,Dt=Ot.b;yt?(_[0]=Wt,_[1]=Yt,_[2]=Dt,_[3]=Ft,V.clearBufferuiv(V.COLOR,0,_)):(b[0]=Wt,b[1]=Yt,b[2]=Dt,b[3]=Ft,V.clearBufferiv(V.COLOR,0,b))}else q|=V.COLOR_BUFFER_BIT}B&&(q|=V.DEPTH_BUFFER_BIT),X&&(q|=V.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),V.clear(q)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.dispose=function(){e.removeEventListener("webglcontextlost",ot,!1),e.removeEventListener("webglcontextrestored",At,!1),e.removeEventListener("webglcontextcreationerror",Rt,!1),Tt.dispose(),Zt.dispose(),Lt.dispose(),y.dispose(),Z.dispose(),nt.dispose(),de.dispose(),z.dispose(),St.dispose(),it.dispose(),it.removeEventListener("sessionstart",Wn),it.removeEventListener("sessionend",zi),Bn.stop()};function ot(T){T.preventDefault(),console.log("THREE.WebGLRenderer: Context Lost."),U=!0}function At(){console.log("THREE.WebGLRenderer: Context Restored."),U=!1;const T=fe.autoReset,B=vt.enabled,X=vt.autoUpdate,q=vt.needsUpdate,H=vt.type;xt(),fe.autoReset=T,vt.enabled=B,vt.autoUpdate=X,vt.needsUpdate=q,vt.type=H}function Rt(T){console.error("THREE.WebGLRenderer: A WebGL context could not be created. Reason: ",T.statusMessage)}function Jt(T){const B=T.target;B.removeEventListener("dispose",Jt),Oe(B)}function Oe(T){fn(T),Lt.remove(T)}function fn(T){const B=Lt.get(T).programs;B!==void 0&&(B.forEach(function(X){St.releaseProgram(X)}),T.isShaderMaterial&&St.releaseShaderCache(T))}this.renderBufferDirect=function(T,B,X,q,H,ut){B===null&&(B=le);const yt=H.isMesh&&H.matrixWorld.determinant()<0,Ot=Gl(T,B,X,q,H);Gt.setMaterial(q,yt);let Ft=X.index,Wt=1;if(q.wireframe===!0){if(Ft=W.getWireframeAttribute(X),Ft===void 0)return;Wt=2}const Yt=X.drawRange,Dt=X.attributes.position;let oe=Yt.start*Wt,xe=(Yt.start+Yt.count)*Wt;ut!==null&&(oe=Math.max(oe,ut.start*Wt),xe=Math.min(xe,(ut.start+ut.count)*Wt)),Ft!==null?(oe=Math.max(oe,0),xe=Math.min(xe,Ft.count)):Dt!=null&&(oe=Math.max(oe,0),xe=Math.min(xe,Dt.count));const Se=xe-oe;if(Se<0||Se===1/0)return;de.setup(H,q,Ot,X,Ft);let dn,he=wt;if(Ft!==null&&(dn=Q.get(Ft),he=se,he.setIndex(dn)),H.isMesh)q.wireframe===!0?(Gt.setLineWidth(q.wireframeLinewidth*ce()),he.setMode(V.LINES)):he.setMode(V.TRIANGLES);else if(H.isLine){let Bt=q.linewidth;Bt===void 0&&(Bt=1),Gt.setLineWidth(Bt*ce()),H.isLineSegments?he.setMode(V.LINES):H.isLineLoop?he.setMode(V.LINE_LOOP):he.setMode(V.LINE_STRIP)}else H.isPoints?he.setMode(V.POINTS):H.isSprite&&he.setMode(V.TRIANGLES);if(H.isBatchedMesh)if(H._multiDrawInstances!==null)he.renderMultiDrawInstances(H._multiDrawStarts,H._multiDrawCounts,H._multiDrawCount,H._multiDrawInstances);else if(Qt.get("WEBGL_multi_draw"))he.renderMultiDraw(H._multiDrawStarts,H._multiDrawCounts,H._multiDrawCount);else{const Bt=H._multiDrawStarts,ke=H._multiDrawCounts,pe=H._multiDrawCount,zn=Ft?Q.get(Ft).bytesPerElement:1,Ai=Lt.get(q).currentProgram.getUniforms();for(let wn=0;wn<pe;wn++)Ai.setValue(V,"_gl_DrawID",wn),he.render(Bt[wn]/zn,ke[wn])}else if(H.isInstancedMesh)he.renderInstances(oe,Se,H.count);else if(X.isInstancedBufferGeometry){const Bt=X._maxInstanceCount!==void 0?X._maxInstanceCount:1/0,ke=Math.min(X.instanceCount,Bt);he.renderInstances(oe,Se,ke)}else he.render(oe,Se)};function ge(T,B,X){T.transparent===!0&&T.side===ki&&T.forceSinglePass===!1?(T.side=Gn,T.needsUpdate=!0,gr(T,B,X),T.side=as,T.needsUpdate=!0,gr(T,B,X),T.side=ki):gr(T,B,X)}this.compile=function(T,B,X=null){X===null&&(X=T),d=Zt.get(X),d.init(B),E.push(d),X.traverseVisible(function(H){H.isLight&&H.layers.test(B.layers)&&(d.pushLight(H),H.castShadow&&d.pushShadow(H))}),T!==X&&T.traverseVisible(function(H){H.isLight&&H.layers.test(B.layers)&&(d.pushLight(H),H.castShadow&&d.pushShadow(H))}),d.setupLights();const q=new Set;return T.traverse(function(H){if(!(H.isMesh||H.isPoints||H.isLine||H.isSprite))return;const ut=H.material;if(ut)if(Array.isArray(ut))for(let yt=0;yt<ut.length;yt++){const Ot=ut[yt];ge(Ot,X,H),q.add(Ot)}else ge(ut,X,H),q.add(ut)}),E.pop(),d=null,q},this.compileAsync=function(T,B,X=null){const q=this.compile(T,B,X);return new Promise(H=>{function ut(){if(q.forEach(function(yt){Lt.get(yt).currentProgram.isReady()&&q.delete(yt)}),q.size===0){H(T);return}setTimeout(ut,10)}Qt.get("KHR_parallel_shader_compile")!==null?ut():setTimeout(ut,10)})};let en=null;function Ie(T){en&&en(T)}function Wn(){Bn.stop()}function zi(){Bn.start()}const Bn=new n_;Bn.setAnimationLoop(Ie),typeof self<"u"&&Bn.setContext(self),this.setAnimationLoop=function(T){en=T,it.setAnimationLoop(T),T===null?Bn.stop():Bn.start()},it.addEventListener("sessionstart",Wn),it.addEventListener("sessionend",zi),this.render=function(T,B){if(B!==void 0&&B.isCamera!==!0){console.error("THREE.WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(U===!0)return;if(T.matrixWorldAutoUpdate===!0&&T.updateMatrixWorld(),B.parent===null&&B.matrixWorldAutoUpdate===!0&&B.updateMatrixWorld(),it.enabled===!0&&it.isPresenting===!0&&(it.cameraAutoUpdate===!0&&it.updateCamera(B),B=it.getCamera()),T.isScene===!0&&T.onBeforeRender(v,T,B,F),d=Zt.get(T,E.length),d.init(B),E.push(d),zt.multiplyMatrices(B.projectionMatrix,B.matrixWorldInverse),st.setFromProjectionMatrix(zt),gt=this.localClippingEnabled,lt=dt.init(this.clippingPlanes,gt),m=Tt.get(T,S.length),m.init(),S.push(m),it.enabled===!0&&it.isPresenting===!0){const ut=v.xr.getDepthSensingMesh();ut!==null&&yn(ut,B,-1/0,v.sortObjects)}yn(T,B,0,v.sortObjects),m.finish(),v.sortObjects===!0&&m.sort(ft,ht),Kt=it.enabled===!1||it.isPresenting===!1||it.hasDepthSensing()===!1,Kt&&Nt.addToRenderList(m,T),this.info.render.frame++,lt===!0&&dt.beginShadows();const X=d.state.shadowsArray;vt.render(X,T,B),lt===!0&&dt.endShadows(),this.info.autoReset===!0&&this.info.reset();const q=m.opaque,H=m.transmissive;if(d.setupLights(),B.isArrayCamera){const ut=B.cameras;if(H.length>0)for(let yt=0,Ot=ut.length;yt<Ot;yt++){const Ft=ut[yt];Hi(q,H,T,Ft)}Kt&&Nt.render(T);for(let yt=0,Ot=ut.length;yt<Ot;yt++){const Ft=ut[yt];Vi(m,T,Ft,Ft.viewport)}}else H.length>0&&Hi(q,H,T,B),Kt&&Nt.render(T),Vi(m,T,B);F!==null&&(C.updateMultisampleRenderTarget(F),C.updateRenderTargetMipmap(F)),T.isScene===!0&&T.onAfterRender(v,T,B),de.resetDefaultState(),w=-1,x=null,E.pop(),E.length>0?(d=E[E.length-1],lt===!0&&dt.setGlobalState(v.clippingPlanes,d.state.camera)):d=null,S.pop(),S.length>0?m=S[S.length-1]:m=null};function yn(T,B,X,q){if(T.visible===!1)return;if(T.layers.test(B.layers)){if(T.isGroup)X=T.renderOrder;else if(T.isLOD)T.autoUpdate===!0&&T.update(B);else if(T.isLight)d.pushLight(T),T.castShadow&&d.pushShadow(T);else if(T.isSprite){if(!T.frustumCulled||st.intersectsSprite(T)){q&&Ut.setFromMatrixPosition(T.matrixWorld).applyMatrix4(zt);const yt=nt.update(T),Ot=T.material;Ot.visible&&m.push(T,yt,Ot,X,Ut.z,null)}}else if((T.isMesh||T.isLine||T.isPoints)&&(!T.frustumCulled||st.intersectsObject(T))){const yt=nt.update(T),Ot=T.material;if(q&&(T.boundingSphere!==void 0?(T.boundingSphere===null&&T.computeBoundingSphere(),Ut.copy(T.boundingSphere.center)):(yt.boundingSphere===null&&yt.computeBoundingSphere(),Ut.copy(yt.boundingSphere.center)),Ut.applyMatrix4(T.matrixWorld).applyMatrix4(zt)),Array.isArray(Ot)){const Ft=yt.groups;for(let Wt=0,Yt=Ft.length;Wt<Yt;Wt++){const Dt=Ft[Wt],oe=Ot[Dt.materialIndex];oe&&oe.visible&&m.push(T,yt,oe,X,Ut.z,Dt)}}else Ot.visible&&m.push(T,yt,Ot,X,Ut.z,null)}}const ut=T.children;for(let yt=0,Ot=ut.length;yt<Ot;yt++)yn(ut[yt],B,X,q)}function Vi(T,B,X,q){const H=T.opaque,ut=T.transmissive,yt=T.transparent;d.setupLightsView(X),lt===!0&&dt.setGlobalState(v.clippingPlanes,X),q&&Gt.viewport(R.copy(q)),H.length>0&&Us(H,B,X),ut.length>0&&Us(ut,B,X),yt.length>0&&Us(yt,B,X),Gt.buffers.depth.setTest(!0),Gt.buffers.depth.setMask(!0),Gt.buffers.color.setMask(!0),Gt.setPolygonOffset(!1)}function Hi(T,B,X,q){if((X.isScene===!0?X.overrideMaterial:null)!==null)return;d.state.transmissionRenderTarget[q.id]===void 0&&(d.state.transmissionRenderTarget[q.id]=new Cs(1,1,{generateMipmaps:!0,type:Qt.has("EXT_color_buffer_half_float")||Qt.has("EXT_color_buffer_float")?ta:ls,minFilter:or,samples:4,stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,colorSpace:ue.workingColorSpace}));const ut=d.state.transmissionRenderTarget[q.id],yt=q.viewport||R;ut.setSize(yt.z,yt.w);const Ot=v.getRenderTarget();v.setRenderTarget(ut),v.getClearColor($),Y=v.getClearAlpha(),Y<1&&v.setClearColor(16777215,.5),v.clear(),Kt&&Nt.render(X);const Ft=v.toneMapping;v.toneMapping=As;const Wt=q.viewport;if(q.viewport!==void 0&&(q.viewport=void 0),d.setupLightsView(q),lt===!0&&dt.setGlobalState(v.clippingPlanes,q),Us(T,X,q),C.updateMultisampleRenderTarget(ut),C.updateRenderTargetMipmap(ut),Qt.has("WEBGL_multisampled_render_to_texture")===!1){let Yt=!1;for(let Dt=0,oe=B.length;Dt<oe;Dt++){const xe=B[Dt],Se=xe.object,dn=xe.geometry,he=xe.material,Bt=xe.group;if(he.side===ki&&Se.layers.test(q.layers)){const ke=he.side;he.side=Gn,he.needsUpdate=!0,So(Se,X,q,dn,he,Bt),he.side=ke,he.needsUpdate=!0,Yt=!0}}Yt===!0&&(C.updateMultisampleRenderTarget(ut),C.updateRenderTargetMipmap(ut))}v.setRenderTarget(Ot),v.setClearColor($,Y),Wt!==void 0&&(q.viewport=Wt),v.toneMapping=Ft}function Us(T,B,X){const q=B.isScene===!0?B.overrideMaterial:null;for(let H=0,ut=T.length;H<ut;H++){const yt=T[H],Ot=yt.object,Ft=yt.geometry,Wt=q===null?yt.material:q,Yt=yt.group;Ot.layers.test(X.layers)&&So(Ot,B,X,Ft,Wt,Yt)}}function So(T,B,X,q,H,ut){T.onBeforeRender(v,B,X,q,H,ut),T.modelViewMatrix.multiplyMatrices(X.matrixWorldInverse,T.matrixWorld),T.normalMatrix.getNormalMatrix(T.modelViewMatrix),H.onBeforeRender(v,B,X,q,T,ut),H.transparent===!0&&H.side===ki&&H.forceSinglePass===!1?(H.side=Gn,H.needsUpdate=!0,v.renderBufferDirect(X,B,q,H,T,ut),H.side=as,H.needsUpdate=!0,v.renderBufferDirect(X,B,q,H,T,ut),H.side=ki):v.renderBufferDirect(X,B,q,H,T,ut),T.onAfterRender(v,B,X,q,H,ut)}function gr(T,B,X){B.isScene!==!0&&(B=le);const q=Lt.get(T),H=d.state.lights,ut=d.state.shadowsArray,yt=H.state.version,Ot=St.getParameters(T,H.state,ut,B,X),Ft=St.getProgramCacheKey(Ot);let Wt=q.programs;q.environment=T.isMeshStandardMaterial?B.environment:null,q.fog=B.fog,q.envMap=(T.isMeshStandardMaterial?Z:y).get(T.envMap||q.environment),q.envMapRotation=q.environment!==null&&T.envMap===null?B.environmentRotation:T.envMapRotation,Wt===void 0&&(T.addEventListener("dispose",Jt),Wt=new Map,q.programs=Wt);let Yt=Wt.get(Ft);if(Yt!==void 0){if(q.currentProgram===Yt&&q.lightsStateVersion===yt)return Ti(T,Ot),Yt}else Ot.uniforms=St.getUniforms(T),T.onBeforeCompile(Ot,v),Yt=St.acquireProgram(Ot,Ft),Wt.set(Ft,Yt),q.uniforms=Ot.uniforms;const Dt=q.uniforms;return(!T.isShaderMaterial&&!T.isRawShaderMaterial||T.clipping===!0)&&(Dt.clippingPlanes=dt.uniform),Ti(T,Ot),q.needsLights=sa(T),q.lightsStateVersion=yt,q.needsLights&&(Dt.ambientLightColor.value=H.state.ambient,Dt.lightProbe.value=H.state.probe,Dt.directionalLights.value=H.state.directional,Dt.directionalLightShadows.value=H.state.directionalShadow,Dt.spotLights.value=H.state.spot,Dt.spotLightShadows.value=H.state.spotShadow,Dt.rectAreaLights.value=H.state.rectArea,Dt.ltc_1.value=H.state.rectAreaLTC1,Dt.ltc_2.value=H.state.rectAreaLTC2,Dt.pointLights.value=H.state.point,Dt.pointLightShadows.value=H.state.pointShadow,Dt.hemisphereLights.value=H.state.hemi,Dt.directionalShadowMap.value=H.state.directionalShadowMap,Dt.directionalShadowMatrix.value=H.state.directionalShadowMatrix,Dt.spotShadowMap.value=H.state.spotShadowMap,Dt.spotLightMatrix.value=H.state.spotLightMatrix,Dt.spotLightMap.value=H.state.spotLightMap,Dt.pointShadowMap.value=H.state.pointShadowMap,Dt.pointShadowMatrix.value=H.state.pointShadowMatrix),q.currentProgram=Yt,q.uniformsList=null,Yt}function ia(T){if(T.uniformsList===null){const B=T.currentProgram.getUniforms();T.uniformsList=Qa.seqWithValue(B.seq,T.uniforms)}return T.uniformsList}function Ti(T,B){const X=Lt.get(T);X.outputColorSpace=B.outputColorSpace,X.batching=B.batching,X.batchingColor=B.batchingColor,X.instancing=B.instancing,X.instancingColor=B.instancingColor,X.instancingMorph=B.instancingMorph,X.skinning=B.skinning,X.morphTargets=B.morphTargets,X.morphNormals=B.morphNormals,X.morphColors=B.morphColors,X.morphTargetsCount=B.morphTargetsCount,X.numClippingPlanes=B.numClippingPlanes,X.numIntersection=B.numClipIntersection,X.vertexAlphas=B.vertexAlphas,X.vertexTangents=B.vertexTangents,X.toneMapping=B.toneMapping}function Gl(T,B,X,q,H){B.isScene!==!0&&(B=le),C.resetTextureUnits();const ut=B.fog,yt=q.isMeshStandardMaterial?B.environment:null,Ot=F===null?v.outputColorSpace:F.isXRRenderTarget===!0?F.texture.colorSpace:pr,Ft=(q.isMeshStandardMaterial?Z:y).get(q.envMap||yt),Wt=q.vertexColors===!0&&!!X.attributes.color&&X.attributes.color.itemSize===4,Yt=!!X.attributes.tangent&&(!!q.normalMap||q.anisotropy>0),Dt=!!X.morphAttributes.position,oe=!!X.morphAttributes.normal,xe=!!X.morphAttributes.color;let Se=As;q.toneMapped&&(F===null||F.isXRRenderTarget===!0)&&(Se=v.toneMapping);const dn=X.morphAttributes.position||X.morphAttributes.normal||X.morphAttributes.color,he=dn!==void 0?dn.length:0,Bt=Lt.get(q),ke=d.state.lights;if(lt===!0&&(gt===!0||T!==x)){const Ln=T===x&&q.id===w;dt.setState(q,T,Ln)}let pe=!1;q.version===Bt.__version?(Bt.needsLights&&Bt.lightsStateVersion!==ke.state.version||Bt.outputColorSpace!==Ot||H.isBatchedMesh&&Bt.batching===!1||!H.isBatchedMesh&&Bt.batching===!0||H.isBatchedMesh&&Bt.batchingColor===!0&&H.colorTexture===null||H.isBatchedMesh&&Bt.batchingColor===!1&&H.colorTexture!==null||H.isInstancedMesh&&Bt.instancing===!1||!H.isInstancedMesh&&Bt.instancing===!0||H.isSkinnedMesh&&Bt.skinning===!1||!H.isSkinnedMesh&&Bt.skinning===!0||H.isInstancedMesh&&Bt.instancingColor===!0&&H.instanceColor===null||H.isInstancedMesh&&Bt.instancingColor===!1&&H.instanceColor!==null||H.isInstancedMesh&&Bt.instancingMorph===!0&&H.morphTexture===null||H.isInstancedMesh&&Bt.instancingMorph===!1&&H.morphTexture!==null||Bt.envMap!==Ft||q.fog===!0&&Bt.fog!==ut||Bt.numClippingPlanes!==void 0&&(Bt.numClippingPlanes!==dt.numPlanes||Bt.numIntersection!==dt.numIntersection)||Bt.vertexAlphas!==Wt||Bt.vertexTangents!==Yt||Bt.morphTargets!==Dt||Bt.morphNormals!==oe||Bt.morphColors!==xe||Bt.toneMapping!==Se||Bt.morphTargetsCount!==he)&&(pe=!0):(pe=!0,Bt.__version=q.version);let zn=Bt.currentProgram;pe===!0&&(zn=gr(q,B,H));let Ai=!1,wn=!1,Os=!1;const Pe=zn.getUniforms(),ti=Bt.uniforms;if(Gt.useProgram(zn.program)&&(Ai=!0,wn=!0,Os=!0),q.id!==w&&(w=q.id,wn=!0),Ai||x!==T){Gt.buffers.depth.getReversed()?(at.copy(T.projectionMatrix),tx(at),ex(at),Pe.setValue(V,"projectionMatrix",at)):Pe.setValue(V,"projectionMatrix",T.projectionMatrix),Pe.setValue(V,"viewMatrix",T.matrixWorldInverse);const Ri=Pe.map.cameraPosition;Ri!==void 0&&Ri.setValue(V,Ht.setFromMatrixPosition(T.matrixWorld)),ee.logarithmicDepthBuffer&&Pe.setValue(V,"logDepthBufFC",2/(Math.log(T.far+1)/Math.LN2)),(q.isMeshPhongMaterial||q.isMeshToonMaterial||q.isMeshLambertMaterial||q.isMeshBasicMaterial||q.isMeshStandardMaterial||q.isShaderMaterial)&&Pe.setValue(V,"isOrthographic",T.isOrthographicCamera===!0),x!==T&&(x=T,wn=!0,Os=!0)}if(H.isSkinnedMesh){Pe.setOptional(V,H,"bindMatrix"),Pe.setOptional(V,H,"bindMatrixInverse");const Ln=H.skeleton;Ln&&(Ln.boneTexture===null&&Ln.computeBoneTexture(),Pe.setValue(V,"boneTexture",Ln.boneTexture,C))}H.isBatchedMesh&&(Pe.setOptional(V,H,"batchingTexture"),Pe.setValue(V,"batchingTexture",H._matricesTexture,C),Pe.setOptional(V,H,"batchingIdTexture"),Pe.setValue(V,"batchingIdTexture",H._indirectTexture,C),Pe.setOptional(V,H,"batchingColorTexture"),H._colorsTexture!==null&&Pe.setValue(V,"batchingColorTexture",H._colorsTexture,C));const hs=X.morphAttributes;if((hs.position!==void 0||hs.normal!==void 0||hs.color!==void 0)&&kt.update(H,X,zn),(wn||Bt.receiveShadow!==H.receiveShadow)&&(Bt.receiveShadow=H.receiveShadow,Pe.setValue(V,"receiveShadow",H.receiveShadow)),q.isMeshGouraudMaterial&&q.envMap!==null&&(ti.envMap.value=Ft,ti.flipEnvMap.value=Ft.isCubeTexture&&Ft.isRenderTargetTexture===!1?-1:1),q.isMeshStandardMaterial&&q.envMap===null&&B.environment!==null&&(ti.envMapIntensity.value=B.environmentIntensity),wn&&(Pe.setValue(V,"toneMappingExposure",v.toneMappingExposure),Bt.needsLights&&Ns(ti,Os),ut&&q.fog===!0&&bt.refreshFogUniforms(ti,ut),bt.refreshMaterialUniforms(ti,q,et,K,d.state.transmissionRenderTarget[T.id]),Qa.upload(V,ia(Bt),ti,C)),q.isShaderMaterial&&q.uniformsNeedUpdate===!0&&(Qa.upload(V,ia(Bt),ti,C),q.uniformsNeedUpdate=!1),q.isSpriteMaterial&&Pe.setValue(V,"center",H.center),Pe.setValue(V,"modelViewMatrix",H.modelViewMatrix),Pe.setValue(V,"normalMatrix",H.normalMatrix),Pe.setValue(V,"modelMatrix",H.matrixWorld),q.isShaderMaterial||q.isRawShaderMaterial){const Ln=q.uniformsGroups;for(let Ri=0,ui=Ln.length;Ri<ui;Ri++){const br=Ln[Ri];z.update(br,zn),z.bind(br,zn)}}return zn}function Ns(T,B){T.ambientLightColor.needsUpdate=B,T.lightProbe.needsUpdate=B,T.directionalLights.needsUpdate=B,T.directionalLightShadows.needsUpdate=B,T.pointLights.needsUpdate=B,T.pointLightShadows.needsUpdate=B,T.spotLights.needsUpdate=B,T.spotLightShadows.needsUpdate=B,T.rectAreaLights.needsUpdate=B,T.hemisphereLights.needsUpdate=B}function sa(T){return T.isMeshLambertMaterial||T.isMeshToonMaterial||T.isMeshPhongMaterial||T.isMeshStandardMaterial||T.isShadowMaterial||T.isShaderMaterial&&T.lights===!0}this.getActiveCubeFace=function(){return P},this.getActiveMipmapLevel=function(){return I},this.getRenderTarget=function(){return F},this.setRenderTargetTextures=function(T,B,X){Lt.get(T.texture).__webglTexture=B,Lt.get(T.depthTexture).__webglTexture=X;const q=Lt.get(T);q.__hasExternalTextures=!0,q.__autoAllocateDepthBuffer=X===void 0,q.__autoAllocateDepthBuffer||Qt.has("WEBGL_multisampled_render_to_texture")===!0&&(console.warn("THREE.WebGLRenderer: Render-to-texture extension was disabled because an external texture was provided"),q.__useRenderToTexture=!1)},this.setRenderTargetFramebuffer=function(T,B){const X=Lt.get(T);X.__webglFramebuffer=B,X.__useDefaultFramebuffer=B===void 0},this.setRenderTarget=function(T,B=0,X=0){F=T,P=B,I=X;let q=!0,H=null,ut=!1,yt=!1;if(T){const Ft=Lt.get(T);if(Ft.__useDefaultFramebuffer!==void 0)Gt.bindFramebuffer(V.FRAMEBUFFER,null),q=!1;else if(Ft.__webglFramebuffer===void 0)C.setupRenderTarget(T);else if(Ft.__hasExternalTextures)C.rebindTextures(T,Lt.get(T.texture).__webglTexture,Lt.get(T.depthTexture).__webglTexture);else if(T.depthBuffer){const Dt=T.depthTexture;if(Ft.__boundDepthTexture!==Dt){if(Dt!==null&&Lt.has(Dt)&&(T.width!==Dt.image.width||T.height!==Dt.image.height))throw new Error("WebGLRenderTarget: Attached DepthTexture is initialized to the incorrect size.");C.setupDepthRenderbuffer(T)}}const Wt=T.texture;(Wt.isData3DTexture||Wt.isDataArrayTexture||Wt.isCompressedArrayTexture)&&(yt=!0);const Yt=Lt.get(T).__webglFramebuffer;T.isWebGLCubeRenderTarget?(Array.isArray(Yt[B])?H=Yt[B][X]:H=Yt[B],ut=!0):T.samples>0&&C.useMultisampledRTT(T)===!1?H=Lt.get(T).__webglMultisampledFramebuffer:Array.isArray(Yt)?H=Yt[X]:H=Yt,R.copy(T.viewport),G.copy(T.scissor),O=T.scissorTest}else R.copy(_t).multiplyScalar(et).floor(),G.copy(Mt).multiplyScalar(et).floor(),O=mt;if(Gt.bindFramebuffer(V.FRAMEBUFFER,H)&&q&&Gt.drawBuffers(T,H),Gt.viewport(R),Gt.scissor(G),Gt.setScissorTest(O),ut){const Ft=Lt.get(T.texture);V.framebufferTexture2D(V.FRAMEBUFFER,V.COLOR_ATTACHMENT0,V.TEXTURE_CUBE_MAP_POSITIVE_X+B,Ft.__webglTexture,X)}else if(yt){const Ft=Lt.get(T.texture),Wt=B||0;V.framebufferTextureLayer(V.FRAMEBUFFER,V.COLOR_ATTACHMENT0,Ft.__webglTexture,X||0,Wt)}w=-1},this.readRenderTargetPixels=function(T,B,X,q,H,ut,yt){if(!(T&&T.isWebGLRenderTarget)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let Ot=Lt.get(T).__webglFramebuffer;if(T.isWebGLCubeRenderTarget&&yt!==void 0&&(Ot=Ot[yt]),Ot){Gt.bindFramebuffer(V.FRAMEBUFFER,Ot);try{const Ft=T.texture,Wt=Ft.format,Yt=Ft.type;if(!ee.textureFormatReadable(Wt)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(!ee.textureTypeReadable(Yt)){console.error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}B>=0&&B<=T.width-q&&X>=0&&X<=T.height-H&&V.readPixels(B,X,q,H,jt.convert(Wt),jt.convert(Yt),ut)}finally{const Ft=F!==null?Lt.get(F).__webglFramebuffer:null;Gt.bindFramebuffer(V.FRAMEBUFFER,Ft)}}},this.readRenderTargetPixelsAsync=async function(T,B,X,q,H,ut,yt){if(!(T&&T.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let Ot=Lt.get(T).__webglFramebuffer;if(T.isWebGLCubeRenderTarget&&yt!==void 0&&(Ot=Ot[yt]),Ot){const Ft=T.texture,Wt=Ft.format,Yt=Ft.type;if(!ee.textureFormatReadable(Wt))throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(!ee.textureTypeReadable(Yt))throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");if(B>=0&&B<=T.width-q&&X>=0&&X<=T.height-H){Gt.bindFramebuffer(V.FRAMEBUFFER,Ot);const Dt=V.createBuffer();V.bindBuffer(V.PIXEL_PACK_BUFFER,Dt),V.bufferData(V.PIXEL_PACK_BUFFER,ut.byteLength,V.STREAM_READ),V.readPixels(B,X,q,H,jt.convert(Wt),jt.convert(Yt),0);const oe=F!==null?Lt.get(F).__webglFramebuffer:null;Gt.bindFramebuffer(V.FRAMEBUFFER,oe);const xe=V.fenceSync(V.SYNC_GPU_COMMANDS_COMPLETE,0);return V.flush(),await Qv(V,xe,4),V.bindBuffer(V.PIXEL_PACK_BUFFER,Dt),V.getBufferSubData(V.PIXEL_PACK_BUFFER,0,ut),V.deleteBuffer(Dt),V.deleteSync(xe),ut}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")}},this.copyFramebufferToTexture=function(T,B=null,X=0){T.isTexture!==!0&&(Ho("WebGLRenderer: copyFramebufferToTexture function signature has changed."),B=arguments[0]||null,T=arguments[1]);const q=Math.pow(2,-X),H=Math.floor(T.image.width*q),ut=Math.floor(T.image.height*q),yt=B!==null?B.x:0,Ot=B!==null?B.y:0;C.setTexture2D(T,0),V.copyTexSubImage2D(V.TEXTURE_2D,X,0,0,yt,Ot,H,ut),Gt.unbindTexture()},this.copyTextureToTexture=function(T,B,X=null,q=null,H=0){T.isTexture!==!0&&(Ho("WebGLRenderer: copyTextureToTexture function signature has changed."),q=arguments[0]||null,T=arguments[1],B=arguments[2],H=arguments[3]||0,X=null);let ut,yt,Ot,Ft,Wt,Yt,Dt,oe,xe;const Se=T.isCompressedTexture?T.mipmaps[H]:T.image;X!==null?(ut=X.max.x-X.min.x,yt=X.max.y-X.min.y,Ot=X.isBox3?X.max.z-X.min.z:1,Ft=X.min.x,Wt=X.min.y,Yt=X.isBox3?X.min.z:0):(ut=Se.width,yt=Se.height,Ot=Se.depth||1,Ft=0,Wt=0,Yt=0),q!==null?(Dt=q.x,oe=q.y,xe=q.z):(Dt=0,oe=0,xe=0);const dn=jt.convert(B.format),he=jt.convert(B.type);let Bt;B.isData3DTexture?(C.setTexture3D(B,0),Bt=V.TEXTURE_3D):B.isDataArrayTexture||B.isCompressedArrayTexture?(C.setTexture2DArray(B,0),Bt=V.TEXTURE_2D_ARRAY):(C.setTexture2D(B,0),Bt=V.TEXTURE_2D),V.pixelStorei(V.UNPACK_FLIP_Y_WEBGL,B.flipY),V.pixelStorei(V.UNPACK_PREMULTIPLY_ALPHA_WEBGL,B.premultiplyAlpha),V.pixelStorei(V.UNPACK_ALIGNMENT,B.unpackAlignment);const ke=V.getParameter(V.UNPACK_ROW_LENGTH),pe=V.getParameter(V.UNPACK_IMAGE_HEIGHT),zn=V.getParameter(V.UNPACK_SKIP_PIXELS),Ai=V.getParameter(V.UNPACK_SKIP_ROWS),wn=V.getParameter(V.UNPACK_SKIP_IMAGES);V.pixelStorei(V.UNPACK_ROW_LENGTH,Se.width),V.pixelStorei(V.UNPACK_IMAGE_HEIGHT,Se.height),V.pixelStorei(V.UNPACK_SKIP_PIXELS,Ft),V.pixelStorei(V.UNPACK_SKIP_ROWS,Wt),V.pixelStorei(V.UNPACK_SKIP_IMAGES,Yt);const Os=T.isDataArrayTexture||T.isData3DTexture,Pe=B.isDataArrayTexture||B.isData3DTexture;if(T.isRenderTargetTexture||T.isDepthTexture){const ti=Lt.get(T),hs=Lt.get(B),Ln=Lt.get(ti.__renderTarget),Ri=Lt.get(hs.__renderTarget);Gt.bindFramebuffer(V.READ_FRAMEBUFFER,Ln.__webglFramebuffer),Gt.bindFramebuffer(V.DRAW_FRAMEBUFFER,Ri.__webglFramebuffer);for(let ui=0;ui<Ot;ui++)Os&&V.framebufferTextureLayer(V.READ_FRAMEBUFFER,V.COLOR_ATTACHMENT0,Lt.get(T).__webglTexture,H,Yt+ui),T.isDepthTexture?(Pe&&V.framebufferTextureLayer(V.DRAW_FRAMEBUFFER,V.COLOR_ATTACHMENT0,Lt.get(B).__webglTexture,H,xe+ui),V.blitFramebuffer(Ft,Wt,ut,yt,Dt,oe,ut,yt,V.DEPTH_BUFFER_BIT,V.NEAREST)):Pe?V.copyTexSubImage3D(Bt,H,Dt,oe,xe+ui,Ft,Wt,ut,yt):V.copyTexSubImage2D(Bt,H,Dt,oe,xe+ui,Ft,Wt,ut,yt);Gt.bindFramebuffer(V.READ_FRAMEBUFFER,null),Gt.bindFramebuffer(V.DRAW_FRAMEBUFFER,null)}else Pe?T.isDataTexture||T.isData3DTexture?V.texSubImage3D(Bt,H,Dt,oe,xe,ut,yt,Ot,dn,he,Se.data):B.isCompressedArrayTexture?V.compressedTexSubImage3D(Bt,H,Dt,oe,xe,ut,yt,Ot,dn,Se.data):V.texSubImage3D(Bt,H,Dt,oe,xe,ut,yt,Ot,dn,he,Se):T.isDataTexture?V.texSubImage2D(V.TEXTURE_2D,H,Dt,oe,ut,yt,dn,he,Se.data):T.isCompressedTexture?V.compressedTexSubImage2D(V.TEXTURE_2D,H,Dt,oe,Se.width,Se.height,dn,Se.data):V.texSubImage2D(V.TEXTURE_2D,H,Dt,oe,ut,yt,dn,he,Se);V.pixelStorei(V.UNPACK_ROW_LENGTH,ke),V.pixelStorei(V.UNPACK_IMAGE_HEIGHT,pe),V.pixelStorei(V.UNPACK_SKIP_PIXELS,zn),V.pixelStorei(V.UNPACK_SKIP_ROWS,Ai),V.pixelStorei(V.UNPACK_SKIP_IMAGES,wn),H===0&&B.generateMipmaps&&V.generateMipmap(Bt),Gt.unbindTexture()},this.copyTextureToTexture3D=function(T,B,X=null,q=null,H=0){return T.isTexture!==!0&&(Ho("WebGLRenderer: copyTextureToTexture3D function signature has changed."),X=arguments[0]||null,q=arguments[1]||null,T=arguments[2],B=arguments[3],H=arguments[4]||0),Ho('WebGLRenderer: copyTextureToTexture3D function has been deprecated. Use "copyTextureToTexture" instead.'),this.copyTextureToTexture(T,B,X,q,H)},this.initRenderTarget=function(T){Lt.get(T).__webglFramebuffer===void 0&&C.setupRenderTarget(T)},this.initTexture=function(T){T.isCubeTexture?C.setTextureCube(T,0):T.isData3DTexture?C.setTexture3D(T,0):T.isDataArrayTexture||T.isCompressedArrayTexture?C.setTexture2DArray(T,0):C.setTexture2D(T,0),Gt.unbindTexture()},this.resetState=function(){P=0,I=0,F=null,Gt.reset(),de.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return ns}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;const e=this.getContext();e.drawingBufferColorspace=ue._getDrawingBufferColorSpace(t),e.unpackColorSpace=ue._getUnpackColorSpace()}}class c_ extends vn{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Ei,this.environmentIntensity=1,this.environmentRotation=new Ei,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),t.background!==null&&(this.background=t.background.clone()),t.environment!==null&&(this.environment=t.environment.clone()),t.fog!==null&&(this.fog=t.fog.clone()),this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),t.overrideMaterial!==null&&(this.overrideMaterial=t.overrideMaterial.clone()),this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){const e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),this.backgroundBlurriness>0&&(e.object.backgroundBlurriness=this.backgroundBlurriness),this.backgroundIntensity!==1&&(e.object.backgroundIntensity=this.backgroundIntensity),e.object.backgroundRotation=this.backgroundRotation.toArray(),this.environmentIntensity!==1&&(e.object.environmentIntensity=this.environmentIntensity),e.object.environmentRotation=this.environmentRotation.toArray(),e}}class h_ extends kn{constructor(t=null,e=1,n=1,s,r,o,a,l,c=Cn,h=Cn,u,f){super(null,o,a,l,c,h,s,r,u,f),this.isDataTexture=!0,this.image={data:t,width:e,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}}class sp extends We{constructor(t,e,n,s=1){super(t,e,n),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=s}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}toJSON(){const t=super.toJSON();return t.meshPerAttribute=this.meshPerAttribute,t.isInstancedBufferAttribute=!0,t}}const Gr=new Re,rp=new Re,Na=[],op=new Fs,uE=new Re,Uo=new an,No=new _r;class fE extends an{constructor(t,e,n){super(t,e),this.isInstancedMesh=!0,this.instanceMatrix=new sp(new Float32Array(n*16),16),this.instanceColor=null,this.morphTexture=null,this.count=n,this.boundingBox=null,this.boundingSphere=null;for(let s=0;s<n;s++)this.setMatrixAt(s,uE)}computeBoundingBox(){const t=this.geometry,e=this.count;this.boundingBox===null&&(this.boundingBox=new Fs),t.boundingBox===null&&t.computeBoundingBox(),this.boundingBox.makeEmpty();for(let n=0;n<e;n++)this.getMatrixAt(n,Gr),op.copy(t.boundingBox).applyMatrix4(Gr),this.boundingBox.union(op)}computeBoundingSphere(){const t=this.geometry,e=this.count;this.boundingSphere===null&&(this.boundingSphere=new _r),t.boundingSphere===null&&t.computeBoundingSphere(),this.boundingSphere.makeEmpty();for(let n=0;n<e;n++)this.getMatrixAt(n,Gr),No.copy(t.boundingSphere).applyMatrix4(Gr),this.boundingSphere.union(No)}copy(t,e){return super.copy(t,e),this.instanceMatrix.copy(t.instanceMatrix),t.morphTexture!==null&&(this.morphTexture=t.morphTexture.clone()),t.instanceColor!==null&&(this.instanceColor=t.instanceColor.clone()),this.count=t.count,t.boundingBox!==null&&(this.boundingBox=t.boundingBox.clone()),t.boundingSphere!==null&&(this.boundingSphere=t.boundingSphere.clone()),this}getColorAt(t,e){e.fromArray(this.instanceColor.array,t*3)}getMatrixAt(t,e){e.fromArray(this.instanceMatrix.array,t*16)}getMorphAt(t,e){const n=e.morphTargetInfluences,s=this.morphTexture.source.data.data,r=n.length+1,o=t*r+1;for(let a=0;a<n.length;a++)n[a]=s[o+a]}raycast(t,e){const n=this.matrixWorld,s=this.count;if(Uo.geometry=this.geometry,Uo.material=this.material,Uo.material!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),No.copy(this.boundingSphere),No.applyMatrix4(n),t.ray.intersectsSphere(No)!==!1))for(let r=0;r<s;r++){this.getMatrixAt(r,Gr),rp.multiplyMatrices(n,Gr),Uo.matrixWorld=rp,Uo.raycast(t,Na);for(let o=0,a=Na.length;o<a;o++){const l=Na[o];l.instanceId=r,l.object=this,e.push(l)}Na.length=0}}setColorAt(t,e){this.instanceColor===null&&(this.instanceColor=new sp(new Float32Array(this.instanceMatrix.count*3).fill(1),3)),e.toArray(this.instanceColor.array,t*3)}setMatrixAt(t,e){e.toArray(this.instanceMatrix.array,t*16)}setMorphAt(t,e){const n=e.morphTargetInfluences,s=n.length+1;this.morphTexture===null&&(this.morphTexture=new h_(new Float32Array(s*this.count),s,this.count,Ru,yi));const r=this.morphTexture.source.data.data;let o=0;for(let c=0;c<n.length;c++)o+=n[c];const a=this.geometry.morphTargetsRelative?1:1-o,l=s*t;r[l]=a,r.set(n,l+1)}updateMorphTargets(){}dispose(){return this.dispatchEvent({type:"dispose"}),this.morphTexture!==null&&(this.morphTexture.dispose(),this.morphTexture=null),this}}class Uu extends Ds{static get type(){return"LineBasicMaterial"}constructor(t){super(),this.isLineBasicMaterial=!0,this.color=new ie(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}}const Ml=new D,Sl=new D,ap=new Re,Oo=new Bl,Oa=new _r,zc=new D,lp=new D;class tl extends vn{constructor(t=new xn,e=new Uu){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){const t=this.geometry;if(t.index===null){const e=t.attributes.position,n=[0];for(let s=1,r=e.count;s<r;s++)Ml.fromBufferAttribute(e,s-1),Sl.fromBufferAttribute(e,s),n[s]=n[s-1],n[s]+=Ml.distanceTo(Sl);t.setAttribute("lineDistance",new Qe(n,1))}else console.warn("THREE.Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}raycast(t,e){const n=this.geometry,s=this.matrixWorld,r=t.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Oa.copy(n.boundingSphere),Oa.applyMatrix4(s),Oa.radius+=r,t.ray.intersectsSphere(Oa)===!1)return;ap.copy(s).invert(),Oo.copy(t.ray).applyMatrix4(ap);const a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=n.index,f=n.attributes.position;if(h!==null){const p=Math.max(0,o.start),_=Math.min(h.count,o.start+o.count);for(let b=p,m=_-1;b<m;b+=c){const d=h.getX(b),S=h.getX(b+1),E=ka(this,t,Oo,l,d,S);E&&e.push(E)}if(this.isLineLoop){const b=h.getX(_-1),m=h.getX(p),d=ka(this,t,Oo,l,b,m);d&&e.push(d)}}else{const p=Math.max(0,o.start),_=Math.min(f.count,o.start+o.count);for(let b=p,m=_-1;b<m;b+=c){const d=ka(this,t,Oo,l,b,b+1);d&&e.push(d)}if(this.isLineLoop){const b=ka(this,t,Oo,l,_-1,p);b&&e.push(b)}}}updateMorphTargets(){const e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){const s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){const a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}}function ka(i,t,e,n,s,r){const o=i.geometry.attributes.position;if(Ml.fromBufferAttribute(o,s),Sl.fromBufferAttribute(o,r),e.distanceSqToSegment(Ml,Sl,zc,lp)>n)return;zc.applyMatrix4(i.matrixWorld);const l=t.ray.origin.distanceTo(zc);if(!(l<t.near||l>t.far))return{distance:l,point:lp.clone().applyMatrix4(i.matrixWorld),index:s,face:null,faceIndex:null,barycoord:null,object:i}}const cp=new D,hp=new D;class u_ extends tl{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){const t=this.geometry;if(t.index===null){const e=t.attributes.position,n=[];for(let s=0,r=e.count;s<r;s+=2)cp.fromBufferAttribute(e,s),hp.fromBufferAttribute(e,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+cp.distanceTo(hp);t.setAttribute("lineDistance",new Qe(n,1))}else console.warn("THREE.LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}}class dE extends Ds{static get type(){return"PointsMaterial"}constructor(t){super(),this.isPointsMaterial=!0,this.color=new ie(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.alphaMap=t.alphaMap,this.size=t.size,this.sizeAttenuation=t.sizeAttenuation,this.fog=t.fog,this}}const up=new Re,nu=new Bl,Ba=new _r,za=new D;class pE extends vn{constructor(t=new xn,e=new dE){super(),this.isPoints=!0,this.type="Points",this.geometry=t,this.material=e,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}raycast(t,e){const n=this.geometry,s=this.matrixWorld,r=t.params.Points.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Ba.copy(n.boundingSphere),Ba.applyMatrix4(s),Ba.radius+=r,t.ray.intersectsSphere(Ba)===!1)return;up.copy(s).invert(),nu.copy(t.ray).applyMatrix4(up);const a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=n.index,u=n.attributes.position;if(c!==null){const f=Math.max(0,o.start),p=Math.min(c.count,o.start+o.count);for(let _=f,b=p;_<b;_++){const m=c.getX(_);za.fromBufferAttribute(u,m),fp(za,m,l,s,t,e,this)}}else{const f=Math.max(0,o.start),p=Math.min(u.count,o.start+o.count);for(let _=f,b=p;_<b;_++)za.fromBufferAttribute(u,_),fp(za,_,l,s,t,e,this)}}updateMorphTargets(){const e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){const s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){const a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}}function fp(i,t,e,n,s,r,o){const a=nu.distanceSqToPoint(i);if(a<e){const l=new D;nu.closestPointToPoint(i,l),l.applyMatrix4(n);const c=s.ray.origin.distanceTo(l);if(c<s.near||c>s.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:t,face:null,faceIndex:null,barycoord:null,object:o})}}class Qo extends xn{constructor(t=1,e=1,n=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:e,height:n,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};const c=this;s=Math.floor(s),r=Math.floor(r);const h=[],u=[],f=[],p=[];let _=0;const b=[],m=n/2;let d=0;S(),o===!1&&(t>0&&E(!0),e>0&&E(!1)),this.setIndex(h),this.setAttribute("position",new Qe(u,3)),this.setAttribute("normal",new Qe(f,3)),this.setAttribute("uv",new Qe(p,2));function S(){const v=new D,U=new D;let P=0;const I=(e-t)/n;for(let F=0;F<=r;F++){const w=[],x=F/r,R=x*(e-t)+t;for(let G=0;G<=s;G++){const O=G/s,$=O*l+a,Y=Math.sin($),J=Math.cos($);U.x=R*Y,U.y=-x*n+m,U.z=R*J,u.push(U.x,U.y,U.z),v.set(Y,I,J).normalize(),f.push(v.x,v.y,v.z),p.push(O,1-x),w.push(_++)}b.push(w)}for(let F=0;F<s;F++)for(let w=0;w<r;w++){const x=b[w][F],R=b[w+1][F],G=b[w+1][F+1],O=b[w][F+1];(t>0||w!==0)&&(h.push(x,R,O),P+=3),(e>0||w!==r-1)&&(h.push(R,G,O),P+=3)}c.addGroup(d,P,0),d+=P}function E(v){const U=_,P=new qt,I=new D;let F=0;const w=v===!0?t:e,x=v===!0?1:-1;for(let G=1;G<=s;G++)u.push(0,m*x,0),f.push(0,x,0),p.push(.5,.5),_++;const R=_;for(let G=0;G<=s;G++){const $=G/s*l+a,Y=Math.cos($),J=Math.sin($);I.x=w*J,I.y=m*x,I.z=w*Y,u.push(I.x,I.y,I.z),f.push(0,x,0),P.x=Y*.5+.5,P.y=J*.5*x+.5,p.push(P.x,P.y),_++}for(let G=0;G<s;G++){const O=U+G,$=R+G;v===!0?h.push($,$+1,O):h.push($+1,$,O),F+=3}c.addGroup(d,F,v===!0?1:2),d+=F}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new Qo(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}}class Nu extends Qo{constructor(t=1,e=1,n=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,t,e,n,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:t,height:e,radialSegments:n,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(t){return new Nu(t.radius,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}}class Ou extends xn{constructor(t=[],e=[],n=1,s=0){super(),this.type="PolyhedronGeometry",this.parameters={vertices:t,indices:e,radius:n,detail:s};const r=[],o=[];a(s),c(n),h(),this.setAttribute("position",new Qe(r,3)),this.setAttribute("normal",new Qe(r.slice(),3)),this.setAttribute("uv",new Qe(o,2)),s===0?this.computeVertexNormals():this.normalizeNormals();function a(S){const E=new D,v=new D,U=new D;for(let P=0;P<e.length;P+=3)p(e[P+0],E),p(e[P+1],v),p(e[P+2],U),l(E,v,U,S)}function l(S,E,v,U){const P=U+1,I=[];for(let F=0;F<=P;F++){I[F]=[];const w=S.clone().lerp(v,F/P),x=E.clone().lerp(v,F/P),R=P-F;for(let G=0;G<=R;G++)G===0&&F===P?I[F][G]=w:I[F][G]=w.clone().lerp(x,G/R)}for(let F=0;F<P;F++)for(let w=0;w<2*(P-F)-1;w++){const x=Math.floor(w/2);w%2===0?(f(I[F][x+1]),f(I[F+1][x]),f(I[F][x])):(f(I[F][x+1]),f(I[F+1][x+1]),f(I[F+1][x]))}}function c(S){const E=new D;for(let v=0;v<r.length;v+=3)E.x=r[v+0],E.y=r[v+1],E.z=r[v+2],E.normalize().multiplyScalar(S),r[v+0]=E.x,r[v+1]=E.y,r[v+2]=E.z}function h(){const S=new D;for(let E=0;E<r.length;E+=3){S.x=r[E+0],S.y=r[E+1],S.z=r[E+2];const v=m(S)/2/Math.PI+.5,U=d(S)/Math.PI+.5;o.push(v,1-U)}_(),u()}function u(){for(let S=0;S<o.length;S+=6){const E=o[S+0],v=o[S+2],U=o[S+4],P=Math.max(E,v,U),I=Math.min(E,v,U);P>.9&&I<.1&&(E<.2&&(o[S+0]+=1),v<.2&&(o[S+2]+=1),U<.2&&(o[S+4]+=1))}}function f(S){r.push(S.x,S.y,S.z)}function p(S,E){const v=S*3;E.x=t[v+0],E.y=t[v+1],E.z=t[v+2]}function _(){const S=new D,E=new D,v=new D,U=new D,P=new qt,I=new qt,F=new qt;for(let w=0,x=0;w<r.length;w+=9,x+=6){S.set(r[w+0],r[w+1],r[w+2]),E.set(r[w+3],r[w+4],r[w+5]),v.set(r[w+6],r[w+7],r[w+8]),P.set(o[x+0],o[x+1]),I.set(o[x+2],o[x+3]),F.set(o[x+4],o[x+5]),U.copy(S).add(E).add(v).divideScalar(3);const R=m(U);b(P,x+0,S,R),b(I,x+2,E,R),b(F,x+4,v,R)}}function b(S,E,v,U){U<0&&S.x===1&&(o[E]=S.x-1),v.x===0&&v.z===0&&(o[E]=U/2/Math.PI+.5)}function m(S){return Math.atan2(S.z,-S.x)}function d(S){return Math.atan2(-S.y,Math.sqrt(S.x*S.x+S.z*S.z))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new Ou(t.vertices,t.indices,t.radius,t.details)}}class io extends Ou{constructor(t=1,e=0){const n=(1+Math.sqrt(5))/2,s=[-1,n,0,1,n,0,-1,-n,0,1,-n,0,0,-1,n,0,1,n,0,-1,-n,0,1,-n,n,0,-1,n,0,1,-n,0,-1,-n,0,1],r=[0,11,5,0,5,1,0,1,7,0,7,10,0,10,11,1,5,9,5,11,4,11,10,2,10,7,6,7,1,8,3,9,4,3,4,2,3,2,6,3,6,8,3,8,9,4,9,5,2,4,11,6,2,10,8,6,7,9,8,1];super(s,r,t,e),this.type="IcosahedronGeometry",this.parameters={radius:t,detail:e}}static fromJSON(t){return new io(t.radius,t.detail)}}class Hl extends xn{constructor(t=1,e=32,n=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:e,heightSegments:n,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},e=Math.max(3,Math.floor(e)),n=Math.max(2,Math.floor(n));const l=Math.min(o+a,Math.PI);let c=0;const h=[],u=new D,f=new D,p=[],_=[],b=[],m=[];for(let d=0;d<=n;d++){const S=[],E=d/n;let v=0;d===0&&o===0?v=.5/e:d===n&&l===Math.PI&&(v=-.5/e);for(let U=0;U<=e;U++){const P=U/e;u.x=-t*Math.cos(s+P*r)*Math.sin(o+E*a),u.y=t*Math.cos(o+E*a),u.z=t*Math.sin(s+P*r)*Math.sin(o+E*a),_.push(u.x,u.y,u.z),f.copy(u).normalize(),b.push(f.x,f.y,f.z),m.push(P+v,1-E),S.push(c++)}h.push(S)}for(let d=0;d<n;d++)for(let S=0;S<e;S++){const E=h[d][S+1],v=h[d][S],U=h[d+1][S],P=h[d+1][S+1];(d!==0||o>0)&&p.push(E,v,P),(d!==n-1||l<Math.PI)&&p.push(v,U,P)}this.setIndex(p),this.setAttribute("position",new Qe(_,3)),this.setAttribute("normal",new Qe(b,3)),this.setAttribute("uv",new Qe(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new Hl(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}}class ku extends cs{static get type(){return"RawShaderMaterial"}constructor(t){super(t),this.isRawShaderMaterial=!0}}class mE extends Ds{static get type(){return"MeshPhongMaterial"}constructor(t){super(),this.isMeshPhongMaterial=!0,this.color=new ie(16777215),this.specular=new ie(1118481),this.shininess=30,this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new ie(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=Lu,this.normalScale=new qt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Ei,this.combine=Dl,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.specular.copy(t.specular),this.shininess=t.shininess,this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}}class _E extends Ds{static get type(){return"MeshLambertMaterial"}constructor(t){super(),this.isMeshLambertMaterial=!0,this.color=new ie(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new ie(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=Lu,this.normalScale=new qt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Ei,this.combine=Dl,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}}class f_ extends vn{constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new ie(t),this.intensity=e}dispose(){}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){const e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,this.groundColor!==void 0&&(e.object.groundColor=this.groundColor.getHex()),this.distance!==void 0&&(e.object.distance=this.distance),this.angle!==void 0&&(e.object.angle=this.angle),this.decay!==void 0&&(e.object.decay=this.decay),this.penumbra!==void 0&&(e.object.penumbra=this.penumbra),this.shadow!==void 0&&(e.object.shadow=this.shadow.toJSON()),this.target!==void 0&&(e.object.target=this.target.uuid),e}}const Vc=new Re,dp=new D,pp=new D;class gE{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new qt(512,512),this.map=null,this.mapPass=null,this.matrix=new Re,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new Fu,this._frameExtents=new qt(1,1),this._viewportCount=1,this._viewports=[new ze(0,0,1,1)]}getViewportCount(){return this._viewportCount}getFrustum(){return this._frustum}updateMatrices(t){const e=this.camera,n=this.matrix;dp.setFromMatrixPosition(t.matrixWorld),e.position.copy(dp),pp.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(pp),e.updateMatrixWorld(),Vc.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),this._frustum.setFromProjectionMatrix(Vc),n.set(.5,0,0,.5,0,.5,0,.5,0,0,.5,.5,0,0,0,1),n.multiply(Vc)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.mapSize.copy(t.mapSize),this}clone(){return new this.constructor().copy(this)}toJSON(){const t={};return this.intensity!==1&&(t.intensity=this.intensity),this.bias!==0&&(t.bias=this.bias),this.normalBias!==0&&(t.normalBias=this.normalBias),this.radius!==1&&(t.radius=this.radius),(this.mapSize.x!==512||this.mapSize.y!==512)&&(t.mapSize=this.mapSize.toArray()),t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}}class bE extends gE{constructor(){super(new i_(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}}class vE extends f_{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(vn.DEFAULT_UP),this.updateMatrix(),this.target=new vn,this.shadow=new bE}dispose(){this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}}class xE extends f_{constructor(t,e){super(t,e),this.isAmbientLight=!0,this.type="AmbientLight"}}class iu{constructor(t=1,e=0,n=0){return this.radius=t,this.phi=e,this.theta=n,this}set(t,e,n){return this.radius=t,this.phi=e,this.theta=n,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=Math.max(1e-6,Math.min(Math.PI-1e-6,this.phi)),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,n){return this.radius=Math.sqrt(t*t+e*e+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,n),this.phi=Math.acos(Rn(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}}const mp=new D,Va=new D;class ME{constructor(t=new D,e=new D){this.start=t,this.end=e}set(t,e){return this.start.copy(t),this.end.copy(e),this}copy(t){return this.start.copy(t.start),this.end.copy(t.end),this}getCenter(t){return t.addVectors(this.start,this.end).multiplyScalar(.5)}delta(t){return t.subVectors(this.end,this.start)}distanceSq(){return this.start.distanceToSquared(this.end)}distance(){return this.start.distanceTo(this.end)}at(t,e){return this.delta(e).multiplyScalar(t).add(this.start)}closestPointToPointParameter(t,e){mp.subVectors(t,this.start),Va.subVectors(this.end,this.start);const n=Va.dot(Va);let r=Va.dot(mp)/n;return e&&(r=Rn(r,0,1)),r}closestPointToPoint(t,e,n){const s=this.closestPointToPointParameter(t,e);return this.delta(n).multiplyScalar(s).add(this.start)}applyMatrix4(t){return this.start.applyMatrix4(t),this.end.applyMatrix4(t),this}equals(t){return t.start.equals(this.start)&&t.end.equals(this.end)}clone(){return new this.constructor().copy(this)}}class SE extends mr{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(){}disconnect(){}dispose(){}update(){}}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:wu}}));typeof window<"u"&&(window.__THREE__?console.warn("WARNING: Multiple instances of Three.js being imported."):window.__THREE__=wu);const _p={type:"change"},Bu={type:"start"},d_={type:"end"},Ha=new Bl,gp=new es,yE=Math.cos(70*Kv.DEG2RAD),nn=new D,Hn=2*Math.PI,Ae={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},Hc=1e-6;class wE extends SE{constructor(t,e=null){super(t,e),this.state=Ae.NONE,this.enabled=!0,this.target=new D,this.cursor=new D,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:Qr.ROTATE,MIDDLE:Qr.DOLLY,RIGHT:Qr.PAN},this.touches={ONE:Zr.ROTATE,TWO:Zr.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._domElementKeyEvents=null,this._lastPosition=new D,this._lastQuaternion=new Ls,this._lastTargetPosition=new D,this._quat=new Ls().setFromUnitVectors(t.up,new D(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new iu,this._sphericalDelta=new iu,this._scale=1,this._panOffset=new D,this._rotateStart=new qt,this._rotateEnd=new qt,this._rotateDelta=new qt,this._panStart=new qt,this._panEnd=new qt,this._panDelta=new qt,this._dollyStart=new qt,this._dollyEnd=new qt,this._dollyDelta=new qt,this._dollyDirection=new D,this._mouse=new qt,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=TE.bind(this),this._onPointerDown=EE.bind(this),this._onPointerUp=AE.bind(this),this._onContextMenu=DE.bind(this),this._onMouseWheel=CE.bind(this),this._onKeyDown=LE.bind(this),this._onTouchStart=IE.bind(this),this._onTouchMove=FE.bind(this),this._onMouseDown=RE.bind(this),this._onMouseMove=PE.bind(this),this._interceptControlDown=UE.bind(this),this._interceptControlUp=NE.bind(this),this.domElement!==null&&this.connect(),this.update()}connect(){this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.getRootNode().addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.removeEventListener("pointermove",this._onPointerMove),this.domElement.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.getRootNode().removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.style.touchAction="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(_p),this.update(),this.state=Ae.NONE}update(t=null){const e=this.object.position;nn.copy(e).sub(this.target),nn.applyQuaternion(this._quat),this._spherical.setFromVector3(nn),this.autoRotate&&this.state===Ae.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let n=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(n)&&isFinite(s)&&(n<-Math.PI?n+=Hn:n>Math.PI&&(n-=Hn),s<-Math.PI?s+=Hn:s>Math.PI&&(s-=Hn),n<=s?this._spherical.theta=Math.max(n,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(n+s)/2?Math.max(n,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{const o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(nn.setFromSpherical(this._spherical),nn.applyQuaternion(this._quatInverse),e.copy(this.target).add(nn),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){const a=nn.length();o=this._clampDistance(a*this._scale);const l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){const a=new D(this._mouse.x,this._mouse.y,0);a.unproject(this.object);const l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;const c=new D(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=nn.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(Ha.origin.copy(this.object.position),Ha.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(Ha.direction))<yE?this.object.lookAt(this.target):(gp.setFromNormalAndCoplanarPoint(this.object.up,this.target),Ha.intersectPlane(gp,this.target))))}else if(this.object.isOrthographicCamera){const o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>Hc||8*(1-this._lastQuaternion.dot(this.object.quaternion))>Hc||this._lastTargetPosition.distanceToSquared(this.target)>Hc?(this.dispatchEvent(_p),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?Hn/60*this.autoRotateSpeed*t:Hn/60/60*this.autoRotateSpeed}_getZoomScale(t){const e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){nn.setFromMatrixColumn(e,0),nn.multiplyScalar(-t),this._panOffset.add(nn)}_panUp(t,e){this.screenSpacePanning===!0?nn.setFromMatrixColumn(e,1):(nn.setFromMatrixColumn(e,0),nn.crossVectors(this.object.up,nn)),nn.multiplyScalar(t),this._panOffset.add(nn)}_pan(t,e){const n=this.domElement;if(this.object.isPerspectiveCamera){const s=this.object.position;nn.copy(s).sub(this.target);let r=nn.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/n.clientHeight,this.object.matrix),this._panUp(2*e*r/n.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/n.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/n.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;const n=this.domElement.getBoundingClientRect(),s=t-n.left,r=e-n.top,o=n.width,a=n.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientX),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);const e=this.domElement;this._rotateLeft(Hn*this._rotateDelta.x/e.clientHeight),this._rotateUp(Hn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateUp(Hn*this.rotateSpeed/this.domElement.clientHeight):this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateUp(-Hn*this.rotateSpeed/this.domElement.clientHeight):this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateLeft(Hn*this.rotateSpeed/this.domElement.clientHeight):this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this._rotateLeft(-Hn*this.rotateSpeed/this.domElement.clientHeight):this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{const e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._rotateStart.set(n,s)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{const e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panStart.set(n,s)}}_handleTouchStartDolly(t){const e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{const n=this._getSecondPointerPosition(t),s=.5*(t.pageX+n.x),r=.5*(t.pageY+n.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);const e=this.domElement;this._rotateLeft(Hn*this._rotateDelta.x/e.clientHeight),this._rotateUp(Hn*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{const e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panEnd.set(n,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){const e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);const o=(t.pageX+e.x)*.5,a=(t.pageY+e.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new qt,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){const e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){const e=t.deltaMode,n={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:n.deltaY*=16;break;case 2:n.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(n.deltaY*=10),n}}function EE(i){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(i.pointerId),this.domElement.addEventListener("pointermove",this._onPointerMove),this.domElement.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(i)&&(this._addPointer(i),i.pointerType==="touch"?this._onTouchStart(i):this._onMouseDown(i)))}function TE(i){this.enabled!==!1&&(i.pointerType==="touch"?this._onTouchMove(i):this._onMouseMove(i))}function AE(i){switch(this._removePointer(i),this._pointers.length){case 0:this.domElement.releasePointerCapture(i.pointerId),this.domElement.removeEventListener("pointermove",this._onPointerMove),this.domElement.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(d_),this.state=Ae.NONE;break;case 1:const t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function RE(i){let t;switch(i.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case Qr.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(i),this.state=Ae.DOLLY;break;case Qr.ROTATE:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=Ae.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=Ae.ROTATE}break;case Qr.PAN:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=Ae.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=Ae.PAN}break;default:this.state=Ae.NONE}this.state!==Ae.NONE&&this.dispatchEvent(Bu)}function PE(i){switch(this.state){case Ae.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(i);break;case Ae.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(i);break;case Ae.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(i);break}}function CE(i){this.enabled===!1||this.enableZoom===!1||this.state!==Ae.NONE||(i.preventDefault(),this.dispatchEvent(Bu),this._handleMouseWheel(this._customWheelEvent(i)),this.dispatchEvent(d_))}function LE(i){this.enabled===!1||this.enablePan===!1||this._handleKeyDown(i)}function IE(i){switch(this._trackPointer(i),this._pointers.length){case 1:switch(this.touches.ONE){case Zr.ROTATE:if(this.enableRotate===!1)return;this._handleTouchStartRotate(i),this.state=Ae.TOUCH_ROTATE;break;case Zr.PAN:if(this.enablePan===!1)return;this._handleTouchStartPan(i),this.state=Ae.TOUCH_PAN;break;default:this.state=Ae.NONE}break;case 2:switch(this.touches.TWO){case Zr.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(i),this.state=Ae.TOUCH_DOLLY_PAN;break;case Zr.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(i),this.state=Ae.TOUCH_DOLLY_ROTATE;break;default:this.state=Ae.NONE}break;default:this.state=Ae.NONE}this.state!==Ae.NONE&&this.dispatchEvent(Bu)}function FE(i){switch(this._trackPointer(i),this.state){case Ae.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(i),this.update();break;case Ae.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(i),this.update();break;case Ae.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(i),this.update();break;case Ae.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(i),this.update();break;default:this.state=Ae.NONE}}function DE(i){this.enabled!==!1&&i.preventDefault()}function UE(i){i.key==="Control"&&(this._controlActive=!0,this.domElement.getRootNode().addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function NE(i){i.key==="Control"&&(this._controlActive=!1,this.domElement.getRootNode().removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}const bp=["side","oblique","behind","above","tip"],Gc=350,OE=1.1,kE=.8,BE=1.2;function vp(i){const t=new Fs,e=new D;for(let a=0;a<i.rest.length;a+=3)t.expandByPoint(e.fromArray(i.rest,a));const n=Array.from({length:8},(a,l)=>new D(l&1?t.max.x:t.min.x,l&2?t.max.y:t.min.y,l&4?t.max.z:t.min.z)),s=i.needles[0],r=s?new D(s.direction.x,s.direction.y,s.direction.z).normalize():new D(1,0,0);if(s){const{x:a,y:l,z:c}=s.entry;n.push(new D(a,l,c).addScaledVector(r,-.75*s.length))}const o=Math.abs(r.y)<.9?new D(0,1,0):new D(0,0,1);return{points:n,size:Math.max(t.getSize(e).length()/2,.01),direction:r,up:o}}function zE(i,t,e,n){const s=new D().crossVectors(e,t).normalize(),r=new D().crossVectors(t,s),o=[s,r,t].map(_=>{const b=i.map(m=>m.dot(_));return[Math.min(...b),Math.max(...b)]}),[a,l]=[_=>(_[0]+_[1])/2,_=>(_[1]-_[0])/2],c=new D;[s,r,t].forEach((_,b)=>c.addScaledVector(_,a(o[b])));const h=Math.tan(n.fov*Math.PI/360),u=l(o[0])/(h*n.aspect),f=l(o[1])/(h*kE),p=OE*Math.max(u,f)+l(o[2]);return{target:c,position:c.clone().addScaledVector(t,p)}}class VE{constructor(t,e,n){this.still=e,this.camera=new ci(30,1,.002,5),this.aim=null,this.goal=null,this.from={position:new D,target:new D},this.controls=new wE(this.camera,t),this.controls.minDistance=.02,this.controls.maxDistance=3,this.controls.addEventListener("change",n),this.controls.addEventListener("start",()=>this.goal=null)}setScene(t){this.aim=t,this.camera.up.copy(t.up),this.look("side",null,!0)}look(t,e,n=this.still()){if(this.aim===null)return;const{points:s,size:r,direction:o,up:a}=this.aim,l=new D().crossVectors(o,a).normalize(),h={side:l.clone().addScaledVector(a,.12),oblique:l.clone().addScaledVector(o,-.7).addScaledVector(a,.5),behind:o.clone().negate().addScaledVector(a,.3).addScaledVector(l,.12),above:a.clone().addScaledVector(l,.02),tip:l.clone().addScaledVector(a,.25)}[t].normalize();let{position:u,target:f}=zE(s,h,a,this.camera);t==="tip"&&e&&(f=new D(e.x,e.y,e.z),u=f.clone().addScaledVector(h,BE*r)),this.from.position.copy(this.camera.position),this.from.target.copy(this.controls.target),this.goal={position:u,target:f,began:n?-Gc:performance.now()},this.move(n?Gc:performance.now())}nudge(t,e,n){this.goal=null;const s=new Ls().setFromUnitVectors(this.camera.up,new D(0,1,0)),r=this.camera.position.clone().sub(this.controls.target).applyQuaternion(s),o=new iu().setFromVector3(r);o.theta-=t*Math.PI/180,o.phi=Math.min(Math.PI-.05,Math.max(.05,o.phi-e*Math.PI/180)),o.radius*=n,r.setFromSpherical(o).applyQuaternion(s.invert()),this.camera.position.copy(this.controls.target).add(r),this.controls.update()}move(t){if(this.goal===null)return!1;const e=Math.min(1,(t-this.goal.began)/Gc),n=e*e*(3-2*e);return this.camera.position.lerpVectors(this.from.position,this.goal.position,n),this.controls.target.lerpVectors(this.from.target,this.goal.target,n),this.controls.update(),e===1&&(this.goal=null),this.goal!==null}}const el=0,HE=1,GE=new D,xp=new ME,Wc=new es,Mp=new D,Ga=new hi;class WE{constructor(){this.tolerance=-1,this.faces=[],this.newFaces=[],this.assigned=new Sp,this.unassigned=new Sp,this.vertices=[]}setFromPoints(t){if(t.length>=4){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.vertices.push(new XE(t[e]));this.compute()}return this}setFromObject(t){const e=[];return t.updateMatrixWorld(!0),t.traverse(function(n){const s=n.geometry;if(s!==void 0){const r=s.attributes.position;if(r!==void 0)for(let o=0,a=r.count;o<a;o++){const l=new D;l.fromBufferAttribute(r,o).applyMatrix4(n.matrixWorld),e.push(l)}}}),this.setFromPoints(e)}containsPoint(t){const e=this.faces;for(let n=0,s=e.length;n<s;n++)if(e[n].distanceToPoint(t)>this.tolerance)return!1;return!0}intersectRay(t,e){const n=this.faces;let s=-1/0,r=1/0;for(let o=0,a=n.length;o<a;o++){const l=n[o],c=l.distanceToPoint(t.origin),h=l.normal.dot(t.direction);if(c>0&&h>=0)return null;const u=h!==0?-c/h:0;if(!(u<=0)&&(h>0?r=Math.min(u,r):s=Math.max(u,s),s>r))return null}return s!==-1/0?t.at(s,e):t.at(r,e),e}intersectsRay(t){return this.intersectRay(t,GE)!==null}makeEmpty(){return this.faces=[],this.vertices=[],this}addVertexToFace(t,e){return t.face=e,e.outside===null?this.assigned.append(t):this.assigned.insertBefore(e.outside,t),e.outside=t,this}removeVertexFromFace(t,e){return t===e.outside&&(t.next!==null&&t.next.face===e?e.outside=t.next:e.outside=null),this.assigned.remove(t),this}removeAllVerticesFromFace(t){if(t.outside!==null){const e=t.outside;let n=t.outside;for(;n.next!==null&&n.next.face===t;)n=n.next;return this.assigned.removeSubList(e,n),e.prev=n.next=null,t.outside=null,e}}deleteFaceVertices(t,e){const n=this.removeAllVerticesFromFace(t);if(n!==void 0)if(e===void 0)this.unassigned.appendChain(n);else{let s=n;do{const r=s.next;e.distanceToPoint(s.point)>this.tolerance?this.addVertexToFace(s,e):this.unassigned.append(s),s=r}while(s!==null)}return this}resolveUnassignedPoints(t){if(this.unassigned.isEmpty()===!1){let e=this.unassigned.first();do{const n=e.next;let s=this.tolerance,r=null;for(let o=0;o<t.length;o++){const a=t[o];if(a.mark===el){const l=a.distanceToPoint(e.point);if(l>s&&(s=l,r=a),s>1e3*this.tolerance)break}}r!==null&&this.addVertexToFace(e,r),e=n}while(e!==null)}return this}computeExtremes(){const t=new D,e=new D,n=[],s=[];for(let r=0;r<3;r++)n[r]=s[r]=this.vertices[0];t.copy(this.vertices[0].point),e.copy(this.vertices[0].point);for(let r=0,o=this.vertices.length;r<o;r++){const a=this.vertices[r],l=a.point;for(let c=0;c<3;c++)l.getComponent(c)<t.getComponent(c)&&(t.setComponent(c,l.getComponent(c)),n[c]=a);for(let c=0;c<3;c++)l.getComponent(c)>e.getComponent(c)&&(e.setComponent(c,l.getComponent(c)),s[c]=a)}return this.tolerance=3*Number.EPSILON*(Math.max(Math.abs(t.x),Math.abs(e.x))+Math.max(Math.abs(t.y),Math.abs(e.y))+Math.max(Math.abs(t.z),Math.abs(e.z))),{min:n,max:s}}computeInitialHull(){const t=this.vertices,e=this.computeExtremes(),n=e.min,s=e.max;let r=0,o=0;for(let f=0;f<3;f++){const p=s[f].point.getComponent(f)-n[f].point.getComponent(f);p>r&&(r=p,o=f)}const a=n[o],l=s[o];let c,h;r=0,xp.set(a.point,l.point);for(let f=0,p=this.vertices.length;f<p;f++){const _=t[f];if(_!==a&&_!==l){xp.closestPointToPoint(_.point,!0,Mp);const b=Mp.distanceToSquared(_.point);b>r&&(r=b,c=_)}}r=-1,Wc.setFromCoplanarPoints(a.point,l.point,c.point);for(let f=0,p=this.vertices.length;f<p;f++){const _=t[f];if(_!==a&&_!==l&&_!==c){const b=Math.abs(Wc.distanceToPoint(_.point));b>r&&(r=b,h=_)}}const u=[];if(Wc.distanceToPoint(h.point)<0){u.push(xi.create(a,l,c),xi.create(h,l,a),xi.create(h,c,l),xi.create(h,a,c));for(let f=0;f<3;f++){const p=(f+1)%3;u[f+1].getEdge(2).setTwin(u[0].getEdge(p)),u[f+1].getEdge(1).setTwin(u[p+1].getEdge(0))}}else{u.push(xi.create(a,c,l),xi.create(h,a,l),xi.create(h,l,c),xi.create(h,c,a));for(let f=0;f<3;f++){const p=(f+1)%3;u[f+1].getEdge(2).setTwin(u[0].getEdge((3-f)%3)),u[f+1].getEdge(0).setTwin(u[p+1].getEdge(1))}}for(let f=0;f<4;f++)this.faces.push(u[f]);for(let f=0,p=t.length;f<p;f++){const _=t[f];if(_!==a&&_!==l&&_!==c&&_!==h){r=this.tolerance;let b=null;for(let m=0;m<4;m++){const d=this.faces[m].distanceToPoint(_.point);d>r&&(r=d,b=this.faces[m])}b!==null&&this.addVertexToFace(_,b)}}return this}reindexFaces(){const t=[];for(let e=0;e<this.faces.length;e++){const n=this.faces[e];n.mark===el&&t.push(n)}return this.faces=t,this}nextVertexToAdd(){if(this.assigned.isEmpty()===!1){let t,e=0;const n=this.assigned.first().face;let s=n.outside;do{const r=n.distanceToPoint(s.point);r>e&&(e=r,t=s),s=s.next}while(s!==null&&s.face===n);return t}}computeHorizon(t,e,n,s){this.deleteFaceVertices(n),n.mark=HE;let r;e===null?r=e=n.getEdge(0):r=e.next;do{const o=r.twin,a=o.face;a.mark===el&&(a.distanceToPoint(t)>this.tolerance?this.computeHorizon(t,o,a,s):s.push(r)),r=r.next}while(r!==e);return this}addAdjoiningFace(t,e){const n=xi.create(t,e.tail(),e.head());return this.faces.push(n),n.getEdge(-1).setTwin(e.twin),n.getEdge(0)}addNewFaces(t,e){this.newFaces=[];let n=null,s=null;for(let r=0;r<e.length;r++){const o=e[r],a=this.addAdjoiningFace(t,o);n===null?n=a:a.next.setTwin(s),this.newFaces.push(a.face),s=a}return n.next.setTwin(s),this}addVertexToHull(t){const e=[];return this.unassigned.clear(),this.removeVertexFromFace(t,t.face),this.computeHorizon(t.point,null,t.face,e),this.addNewFaces(t,e),this.resolveUnassignedPoints(this.newFaces),this}cleanup(){return this.assigned.clear(),this.unassigned.clear(),this.newFaces=[],this}compute(){let t;for(this.computeInitialHull();(t=this.nextVertexToAdd())!==void 0;)this.addVertexToHull(t);return this.reindexFaces(),this.cleanup(),this}}class xi{constructor(){this.normal=new D,this.midpoint=new D,this.area=0,this.constant=0,this.outside=null,this.mark=el,this.edge=null}static create(t,e,n){const s=new xi,r=new Xc(t,s),o=new Xc(e,s),a=new Xc(n,s);return r.next=a.prev=o,o.next=r.prev=a,a.next=o.prev=r,s.edge=r,s.compute()}getEdge(t){let e=this.edge;for(;t>0;)e=e.next,t--;for(;t<0;)e=e.prev,t++;return e}compute(){const t=this.edge.tail(),e=this.edge.head(),n=this.edge.next.head();return Ga.set(t.point,e.point,n.point),Ga.getNormal(this.normal),Ga.getMidpoint(this.midpoint),this.area=Ga.getArea(),this.constant=this.normal.dot(this.midpoint),this}distanceToPoint(t){return this.normal.dot(t)-this.constant}}class Xc{constructor(t,e){this.vertex=t,this.prev=null,this.next=null,this.twin=null,this.face=e}head(){return this.vertex}tail(){return this.prev?this.prev.vertex:null}length(){const t=this.head(),e=this.tail();return e!==null?e.point.distanceTo(t.point):-1}lengthSquared(){const t=this.head(),e=this.tail();return e!==null?e.point.distanceToSquared(t.point):-1}setTwin(t){return this.twin=t,t.twin=this,this}}class XE{constructor(t){this.point=t,this.prev=null,this.next=null,this.face=null}}class Sp{constructor(){this.head=null,this.tail=null}first(){return this.head}last(){return this.tail}clear(){return this.head=this.tail=null,this}insertBefore(t,e){return e.prev=t.prev,e.next=t,e.prev===null?this.head=e:e.prev.next=e,t.prev=e,this}insertAfter(t,e){return e.prev=t,e.next=t.next,e.next===null?this.tail=e:e.next.prev=e,t.next=e,this}append(t){return this.head===null?this.head=t:this.tail.next=t,t.prev=this.tail,t.next=null,this.tail=t,this}appendChain(t){for(this.head===null?this.head=t:this.tail.next=t,t.prev=this.tail;t.next!==null;)t=t.next;return this.tail=t,this}remove(t){return t.prev===null?this.head=t.next:t.prev.next=t.next,t.next===null?this.tail=t.prev:t.next.prev=t.prev,this}removeSubList(t,e){return t.prev===null?this.head=e.next:t.prev.next=e.next,e.next===null?this.tail=t.prev:e.next.prev=t.prev,this}isEmpty(){return this.head===null}}class YE extends xn{constructor(t=[]){super();const e=[],n=[],r=new WE().setFromPoints(t).faces;for(let o=0;o<r.length;o++){const a=r[o];let l=a.edge;do{const c=l.head().point;e.push(c.x,c.y,c.z),n.push(a.normal.x,a.normal.y,a.normal.z),l=l.next}while(l!==a.edge)}this.setAttribute("position",new Qe(e,3)),this.setAttribute("normal",new Qe(n,3))}}const si=10,Yc=160,ko=.028,qE=.012,jE=.09,yl=512,ar=i=>new D(i.x,i.y,i.z),Rs=(i,t={})=>new _E({color:i,...t});class $E{constructor(t){this.radius=t;const e=new xn,n=Yc*si;this.places=new We(new Float32Array(3*n),3),this.normals=new We(new Float32Array(3*n),3),e.setAttribute("position",this.places),e.setAttribute("normal",this.normals);const s=[];for(let r=0;r+1<Yc;++r)for(let o=0;o<si;++o){const[a,l]=[r*si+o,r*si+(o+1)%si];s.push(a,l,a+si,l,l+si,a+si)}e.setIndex(s),this.mesh=new an(e,new mE({color:on.needle})),this.mesh.frustumCulled=!1}show(t){const e=t.slice(0,Yc-1);if(e.length<2)return;const n=new D,s=new D().subVectors(e[1],e[0]).normalize();n.set(Math.abs(s.x)>.9?0:1,Math.abs(s.x)>.9?1:0,0),e.forEach((o,a)=>{const l=e[Math.min(a+1,e.length-1)],c=e[Math.max(a-1,0)];s.subVectors(l,c).normalize(),n.addScaledVector(s,-n.dot(s)).normalize(),this.ring(a,o,s,n,this.radius)});const r=e[e.length-1].clone();this.ring(e.length,r,s,n,0),this.ring(e.length-1,r.addScaledVector(s,-4*this.radius),s,n,this.radius),this.mesh.geometry.setDrawRange(0,e.length*si*6),this.places.needsUpdate=this.normals.needsUpdate=!0}ring(t,e,n,s,r){const o=new D().crossVectors(n,s);for(let a=0;a<si;++a){const l=2*Math.PI*a/si,[c,h]=[Math.cos(l),Math.sin(l)],u=[0,1,2].map(p=>c*s.getComponent(p)+h*o.getComponent(p)),f=t*si+a;this.normals.setXYZ(f,u[0],u[1],u[2]),this.places.setXYZ(f,e.x+r*u[0],e.y+r*u[1],e.z+r*u[2])}}}class ZE{constructor(t){this.info=t,this.group=new Ts,this.tube=new $E(Math.max(t.outerRadius,6e-4));const e=Math.max(5*t.outerRadius,.0035),n=new Qo(e,.75*e,ko,20);n.rotateX(Math.PI/2),n.translate(0,0,ko/2),this.handle=new an(n,Rs(on.handle));const s=new xo(1.1*e,.35*e,.5*ko);s.translate(1.1*e,0,ko/2),this.handle.add(new an(s,Rs(on.needle))),this.arrow=new Ts;const r=Rs(on.force,{emissive:"#3d2900"});this.shaft=new an(new Qo(.0011,.0011,1,12).translate(0,.5,0),r),this.head=new an(new Nu(.0034,.009,16).translate(0,.0045,0),r),this.arrow.add(this.shaft,this.head),this.group.add(this.tube.mesh,this.handle,this.arrow)}show(t){this.handle.position.copy(ar(t.handle));const e=t.handleRotation;this.handle.quaternion.set(e.x,e.y,e.z,e.w);const n=[this.handle.position,this.pointAhead()];this.tube.show(t.nodes.length>1?t.nodes.map(ar):n);const s=ar(t.force),r=s.length();if(this.arrow.visible=r>.02,!this.arrow.visible)return;const o=Math.min(jE,qE*r),a=ar(t.handle).add(new D(0,0,ko).applyQuaternion(this.handle.quaternion));this.arrow.position.copy(a),this.arrow.quaternion.setFromUnitVectors(new D(0,1,0),s.divideScalar(r)),this.shaft.scale.set(1,o,1),this.head.position.set(0,o,0)}pointAhead(){return new D(0,0,-this.info.length).applyQuaternion(this.handle.quaternion).add(this.handle.position)}}class qc{constructor(t,e){this.mesh=new fE(t,e,yl),this.mesh.frustumCulled=!1,this.mesh.count=0}show(t){const e=new Re;this.mesh.count=Math.min(t.length,yl);for(let n=0;n<this.mesh.count;++n)this.mesh.setMatrixAt(n,e.makeTranslation(t[n].x,t[n].y,t[n].z));this.mesh.instanceMatrix.needsUpdate=!0}}function KE(i){const t=Rs(on.obstacle,{flatShading:i.vertices.length>1});let e;if(i.vertices.length===1){const r=i.vertices[0];e=new Hl(i.rounding,32,20),e.translate(r.x,r.y,r.z)}else{const r=i.rounding>0?JE(i.rounding):[new D],o=i.vertices.flatMap(a=>r.map(l=>ar(a).add(l)));e=new YE(o)}const n=new an(e,t),s=i.rotation;return n.position.copy(ar(i.position)),n.quaternion.set(s.x,s.y,s.z,s.w),n}function JE(i){const t=new io(i,1).getAttribute("position");return Array.from({length:t.count},(e,n)=>new D().fromBufferAttribute(t,n))}function QE(i){const t=new Ts,e=i.forbidden?on.forbidden:on.target,n=Math.max(i.radius,.001),s=new an(new Hl(n,28,18),Rs(e,{transparent:!0,opacity:.35,depthWrite:!1}));s.renderOrder=1,t.add(s);const r=new Uu({color:e}),o=new xn().setFromPoints(Array.from({length:49},(l,c)=>{const h=2*Math.PI*c/48;return new D(n*Math.cos(h),n*Math.sin(h),0)})),a=i.forbidden?[-.75,-.4,0,.4,.75]:[0];for(const l of a){const c=new tl(o,r);c.scale.setScalar(Math.sqrt(1-l*l)),c.position.z=l*n,t.add(c)}if(!i.forbidden){const l=new tl(o,r);l.rotation.x=Math.PI/2;const c=new tl(o,r);c.rotation.y=Math.PI/2,t.add(l,c)}return t.position.copy(ar(i.position)),t}class tT{constructor(t){this.group=new Ts,this.needles=t.needles.map(o=>new ZE(o));const e=Math.min(.0014,t.voxelEdge/4);this.particles=new qc(new io(e,2),Rs(on.particle));const n=Rs(on.goal,{transparent:!0,opacity:.75});this.goals=new qc(new io(.8*e,1),n),this.touches=new qc(new io(1.2*e,2),Rs(on.force));const s=new xn;s.setAttribute("position",new We(new Float32Array(6*yl),3)),this.links=new u_(s,new Uu({color:on.goal})),this.links.frustumCulled=!1;const r=[...this.needles.map(o=>o.group),this.particles.mesh,this.goals.mesh,this.touches.mesh,this.links,...t.obstacles.filter(o=>o.vertices.length>0).map(KE),...t.targets.map(QE)];this.group.add(...r)}show(t){t.needles.forEach((s,r)=>this.needles[r]?.show(s)),this.particles.show(t.particles.map(s=>s.position)),this.goals.show(t.particles.map(s=>s.goal)),this.touches.show(t.touches.map(s=>s.position));const e=this.links.geometry.getAttribute("position"),n=Math.min(t.particles.length,yl);for(let s=0;s<n;++s){const{position:r,goal:o}=t.particles[s];e.setXYZ(2*s,r.x,r.y,r.z),e.setXYZ(2*s+1,o.x,o.y,o.z)}e.needsUpdate=!0,this.links.geometry.setDrawRange(0,2*n)}showParticles(t){for(const e of[this.particles.mesh,this.goals.mesh,this.links])e.visible=t}}function eT(i){i.traverse(t=>{const e=t;e.geometry?.dispose();for(const n of[e.material??[]].flat())n.dispose()})}const Yo=256,p_=`
precision highp int;
precision highp isampler2D;
uniform isampler2D moved;
uniform float unit;

vec3 movedOf(uint particle) {
  return vec3(texelFetch(moved, ivec2(int(particle & 255u), int(particle >> 8u)), 0).xyz);
}
`,m_=`
${p_}
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
`;function nT(i){const t=Math.max(1,Math.ceil(i.particles/Yo)),e=new h_(new Int16Array(4*Yo*t),Yo,t,Ol,Eu);return e.internalFormat="RGBA16I",e.minFilter=e.magFilter=Cn,e.generateMipmaps=!1,e.unpackAlignment=1,e.needsUpdate=!0,{texture:e,uniforms:{moved:{value:e},unit:{value:i.positionUnit},perEdge:{value:1/i.voxelEdge}}}}function yp(i,t){i.texture.image.data.set(t),i.texture.needsUpdate=!0}function iT(i,t){const e=i.vertexVoxel.length,n=new Uint32Array(4*e),s=new Uint32Array(4*e);for(let a=0;a<e;++a){const l=t.corners.subarray(8*i.vertexVoxel[a],8*i.vertexVoxel[a]+8);n.set(l.subarray(0,4),4*a),s.set(l.subarray(4,8),4*a)}const r=a=>{const l=new We(a,4);return l.gpuType=Nl,l},o=new xn;return o.setAttribute("position",new We(i.vertexRest,3)),o.setAttribute("normal",new We(i.vertexNormal,3)),o.setAttribute("fraction",new We(i.vertexFraction,3)),o.setAttribute("low",r(n)),o.setAttribute("high",r(s)),o.setIndex(new We(i.triangles,1)),o}function sT(i,t,e){const n=t.getAttribute("position").count,[s,r]=[Yo,Math.ceil(n/Yo)],o=new Cs(s,r,{type:yi,minFilter:Cn,magFilter:Cn,depthBuffer:!1}),a=new ku({glslVersion:Jo,uniforms:{...e.uniforms,size:{value:new qt(s,r)}},vertexShader:`precision highp float;
      ${m_}
      in vec3 position;
      in vec3 normal;
      uniform vec2 size;
      out vec3 at;
      void main() {
        vec3 turned;
        deform(position, normal, at, turned);
        vec2 cell = vec2(float(gl_VertexID & 255), float(gl_VertexID >> 8));
        gl_Position = vec4((cell + 0.5) / size * 2.0 - 1.0, 0.0, 1.0);
        gl_PointSize = 1.0;
      }`,fragmentShader:`precision highp float;
      in vec3 at;
      out vec4 colour;
      void main() { colour = vec4(at, 1.0); }`,depthTest:!1,depthWrite:!1,blending:rs}),l=t.clone();l.setIndex(null);const c=new pE(l,a);c.frustumCulled=!1;const h=new c_;h.add(c),i.setRenderTarget(o),i.render(h,new Iu);const u=new Float32Array(4*s*r);i.readRenderTargetPixels(o,0,0,s,r,u),i.setRenderTarget(null);for(const p of[o,a,l])p.dispose();const f=new Float32Array(3*n);for(let p=0;p<n;++p)f.set(u.subarray(4*p,4*p+3),3*p);return f}const rT=`
precision highp float;
${m_}
in vec3 position;
in vec3 normal;
in vec3 colour;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
uniform mat3 normalMatrix;
out vec3 vNormal;
out vec3 vPlace;
out vec3 vView;
out vec3 vColour;
void main() {
  vec3 turned;
  deform(position, normal, vPlace, turned);
  vec4 view = modelViewMatrix * vec4(vPlace, 1.0);
  vNormal = normalMatrix * turned;
  vView = view.xyz;
  vColour = colour;
  gl_Position = projectionMatrix * view;
}`,oT=`
precision highp float;
in vec3 vNormal;
in vec3 vPlace;
in vec3 vView;
in vec3 vColour;
uniform vec4 plane;  // what lies beyond it is not drawn
uniform float clear; // 0 solid, 1 x-ray
uniform vec3 inside;
uniform vec3 upward;
out vec4 colour;
void main() {
  if (dot(plane.xyz, vPlace) > plane.w) discard;
  if (!gl_FrontFacing) {
    if (clear > 0.5) discard;
    colour = vec4(mix(inside, vColour, 0.25), 1.0);
    return;
  }
  vec3 n = normalize(vNormal);
  float facing = max(0.0, -dot(n, normalize(vView)));
  float lit = 0.36 + 0.44 * facing + 0.22 * (0.5 + 0.5 * dot(n, upward));
  float shine = facing * facing;
  shine *= shine;
  shine *= shine;
  shine *= shine;
  vec3 shaded = vColour * lit + 0.10 * shine;
  float rim = 1.0 - facing;
  float alpha = mix(1.0, 0.16 + 0.62 * rim * rim, clear);
  colour = vec4(shaded, alpha);
}`,aT=`
precision highp float;
${p_}
in vec3 position;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
out vec3 vPlace;
void main() {
  vPlace = position + unit * movedOf(uint(gl_VertexID));
  gl_Position = projectionMatrix * modelViewMatrix * vec4(vPlace, 1.0);
}`,lT=`
precision highp float;
in vec3 vPlace;
uniform vec4 plane;
uniform vec3 ink;
out vec4 colour;
void main() {
  if (dot(plane.xyz, vPlace) > plane.w) discard;
  colour = vec4(ink, 0.45);
}`;function cT(i){const t=i.materials.map((n,s)=>new ie(Op(s)).toArray()),e=new Float32Array(3*i.vertexVoxel.length);return i.vertexVoxel.forEach((n,s)=>{e.set(t[i.voxelMaterial[n]]??[.5,.5,.5],3*s)}),e}function hT(i,t,e,n){const s=iT(i,t);s.setAttribute("colour",new We(cT(i),3));const r=new ku({glslVersion:Jo,vertexShader:rT,fragmentShader:oT,uniforms:{...e.uniforms,plane:n,clear:{value:0},inside:{value:new ie(on.inside)},upward:{value:new D(0,1,0)}}}),o=new an(s,r);return o.frustumCulled=!1,o.renderOrder=2,{mesh:o,lattice:uT(i,t,e,n)}}function uT(i,t,e,n){const s=new xn;s.setAttribute("position",new We(t.rest,3)),s.setIndex(new We(Mg(i,t.corners),1));const r=new ku({glslVersion:Jo,vertexShader:aT,fragmentShader:lT,uniforms:{...e.uniforms,plane:n,ink:{value:new ie(on.lattice)}},transparent:!0}),o=new u_(s,r);return o.frustumCulled=!1,o.renderOrder=3,o}function fT(i,t,e){const n=i.mesh.material;n.uniforms.clear.value=t?1:0,n.transparent=t,n.depthWrite=!t,n.side=e?ki:as,n.needsUpdate=!0}const wp=60;class dT{constructor(){this.pictures=0,this.kept={message:[],upload:[],bodies:[],draw:[]},this.drawn=[]}time(t,e){const n=performance.now(),s=e(),r=this.kept[t];return r.push(performance.now()-n),r.length>wp&&r.shift(),s}clear(){this.kept={message:[],upload:[],bodies:[],draw:[]}}tick(){for(++this.pictures,this.drawn.push(performance.now());this.drawn.length>2*wp;)this.drawn.shift()}perSecond(){const t=performance.now()-1e3;return this.drawn.filter(e=>e>t).length}median(t){const e=[...this.kept[t]].sort((n,s)=>n-s);return e[e.length>>1]??0}}class pT{constructor(t,e,n){this.canvas=t,this.store=e,this.budget=new dT,this.look={xray:!1,lattice:!1,particles:!1,surface:!0,cut:!1,cutAt:.5},this.finish=!1,this.always=!1,this.drawn=()=>{},this.scene=new c_,this.plane={value:new ze(0,0,0,1)},this.deformation=null,this.surface=null,this.bodies=null,this.stale=!0,this.fresh=!1,ue.enabled=!1,this.renderer=new hE({canvas:t,antialias:!0,alpha:!0,powerPreference:"high-performance",preserveDrawingBuffer:!1}),this.renderer.outputColorSpace=pr,this.renderer.setClearColor(0,0),this.cameraMan=new VE(t,n,()=>this.stale=!0),this.cameraMan.camera.add(new vE("#ffffff",1.5).translateY(.4).translateZ(1)),this.scene.add(this.cameraMan.camera,new xE("#ffffff",1.1)),e.on(["organ"],()=>this.rebuild()),e.on(["frame"],()=>this.fresh=this.stale=!0),new ResizeObserver(()=>this.resize()).observe(t),t.addEventListener("webglcontextlost",s=>s.preventDefault()),t.addEventListener("webglcontextrestored",()=>this.rebuild())}setLook(t){Object.assign(this.look,t),this.applyLook()}preset(t){this.cameraMan.look(t,this.store.frame?.needles[this.store.needle]?.tip??null),this.stale=!0}project(t){const e=new D(t.x,t.y,t.z).project(this.cameraMan.camera);if(e.z>1)return null;const{clientWidth:n,clientHeight:s}=this.canvas;return{x:(e.x+1)/2*n,y:(1-e.y)/2*s}}deformedVertices(){return this.surface===null||this.deformation===null?new Float32Array:(yp(this.deformation,this.store.moved),sT(this.renderer,this.surface.mesh.geometry,this.deformation))}rebuild(){const{hello:t,organ:e}=this.store;for(const s of[this.bodies?.group,this.surface?.mesh,this.surface?.lattice])s&&(this.scene.remove(s),eT(s));if(this.deformation?.texture.dispose(),t===null||e===null)return;this.deformation=nT(t),this.surface=hT(e,t,this.deformation,this.plane),this.bodies=new tT(t),this.scene.add(this.surface.mesh,this.surface.lattice,this.bodies.group);const n=vp(t);this.surface.mesh.material.uniforms.upward.value.copy(n.up),this.cameraMan.setScene(n),this.resize(),this.applyLook(),this.fresh=this.store.frame!==null}applyLook(){this.stale=!0;const{hello:t}=this.store;if(this.surface===null||this.bodies===null||t===null)return;const{xray:e,lattice:n,particles:s,surface:r,cut:o,cutAt:a}=this.look;fT(this.surface,e,o),this.surface.mesh.visible=r,this.surface.lattice.visible=n,this.bodies.showParticles(s);const{direction:l,up:c}=vp(t),h=new D().crossVectors(l,c).normalize();let[u,f]=[1/0,-1/0];for(let _=0;_<t.rest.length;_+=3){const b=h.x*t.rest[_]+h.y*t.rest[_+1]+h.z*t.rest[_+2];u=Math.min(u,b),f=Math.max(f,b)}const p=o?f-a*(f-u):1e3;this.plane.value.set(h.x,h.y,h.z,p)}resize(){const{clientWidth:t,clientHeight:e}=this.canvas;t===0||e===0||(this.renderer.setPixelRatio(Math.min(window.devicePixelRatio,2)),this.renderer.setSize(t,e,!1),this.cameraMan.camera.aspect=t/e,this.cameraMan.camera.updateProjectionMatrix(),this.stale=!0)}step(){if(this.always&&(this.fresh=this.stale=this.store.frame!==null),this.cameraMan.move(performance.now())&&(this.stale=!0),!this.stale||this.canvas.clientWidth===0)return;this.stale=!1;const{frame:t}=this.store;if(this.fresh&&t!==null&&this.deformation!==null){const e=this.deformation;this.budget.time("upload",()=>yp(e,this.store.moved)),this.budget.time("bodies",()=>this.bodies?.show(t)),this.fresh=!1}this.budget.time("draw",()=>{this.renderer.render(this.scene,this.cameraMan.camera),this.finish&&this.waitForGpu()}),this.budget.tick(),this.drawn()}waitForGpu(){const t=this.renderer.getContext();t.readPixels(0,0,1,1,t.RGBA,t.UNSIGNED_BYTE,new Uint8Array(4))}}const Wa=6,jc=.9,$c=["surface","xray","lattice","particles","cut"],mT={trainee:{surface:!0,xray:!1,lattice:!1,particles:!1,cut:!1},teacher:{surface:!0,xray:!0,lattice:!1,particles:!1,cut:!1},engineer:{surface:!0,xray:!0,lattice:!0,particles:!0,cut:!1}};class _T{constructor(t){this.store=t,this.canvas=tt("canvas",{id:"scene-canvas",tabindex:0,role:"application","aria-label":k.view3d.canvas}),this.view=null,this.cutAt=tt("input",{type:"range",min:0,max:1,step:.01,value:.5,"aria-label":k.view3d.cutAt,hidden:!0}),this.rate=tt("span",{class:"rate",title:k.view3d.frameRateLabel}),this.legend=tt("ul",{class:"key","aria-label":k.view3d.legend}),this.labels=tt("div",{class:"labels","aria-hidden":"true"}),this.organText=tt("span",{class:"organ-text"}),this.looks=structuredClone(mT),this.switches=Object.fromEntries($c.map(n=>[n,nh(k.view3d[n],s=>this.change({[n]:s}))]));const e=bp.map(n=>Je(k.view3d.presets[n],()=>this.view?.preset(n)));this.root=tt("section",{class:"scene","aria-label":k.view3d.label,id:"scene"},this.canvas,this.labels,tt("div",{class:"scene-top"},this.legend,tt("div",{class:"scene-numbers"},this.organText,this.rate)),tt("div",{class:"scene-tools"},tt("div",{class:"group",role:"group","aria-label":k.view3d.presetsLabel},...e),tt("div",{class:"group looks",role:"group","aria-label":k.view3d.toolbar},...$c.map(n=>this.switches[n]),this.cutAt))),this.cutAt.addEventListener("input",()=>this.view?.setLook({cutAt:Number(this.cutAt.value)})),this.canvas.addEventListener("keydown",n=>this.key(n)),t.on(["view"],()=>this.applyView()),t.on(["organ"],()=>this.applyOrgan()),window.setInterval(()=>this.showRate(),500)}begin(){try{this.view=new pT(this.canvas,this.store,cg)}catch{return!1}return this.view.drawn=()=>this.placeLabels(),this.applyView(),!0}change(t){Object.assign(this.looks[this.store.view]??={},t),this.view?.setLook(t),this.cutAt.hidden=!(this.view?.look.cut??!1),this.drawLegend()}applyView(){const t=this.looks[this.store.view];if(t!==void 0){for(const e of $c)au(this.switches[e],t[e]===!0);this.change(t)}}applyOrgan(){const{organ:t}=this.store;t!==null&&(Sn(this.organText,k.loop.voxels(t.voxelCount,t.triangles.length/3)),this.labels.replaceChildren(...(this.store.hello?.targets??[]).map(e=>tt("span",{},e.name))),this.drawLegend())}drawLegend(){const{organ:t,hello:e}=this.store,n=this.view?.look;if(t===null||e===null||n===void 0)return;const s=new Set;for(const o of t.vertexVoxel)s.add(t.voxelMaterial[o]);const r=[...s].sort((o,a)=>o-a).map(o=>[t.materials[o]??"",Op(o),"dot"]);n.particles&&(r.push([k.view3d.legendParticle,on.particle,"dot"]),r.push([k.view3d.legendGoal,on.goal,"dot"])),n.lattice&&r.push([k.view3d.legendLattice,on.lattice,"line"]),e.targets.some(o=>!o.forbidden)&&r.push([k.view3d.legendTarget,on.target,"ring"]),e.targets.some(o=>o.forbidden)&&r.push([k.view3d.legendForbidden,on.forbidden,"bars"]),r.push([k.view3d.legendForce,on.force,"line"]),this.legend.replaceChildren(...r.map(([o,a,l])=>{const c=tt("span",{class:`sign ${l}`});return c.style.setProperty("--sign",a),tt("li",{},c,o)}))}placeLabels(){const t=this.store.view!=="trainee",e=this.store.hello?.targets??[];[...this.labels.children].forEach((n,s)=>{const r=t&&e[s]?this.view?.project(e[s].position):null,{style:o}=n;o.display=r?"":"none",r&&(o.transform=`translate(${r.x.toFixed(1)}px, ${r.y.toFixed(1)}px)`)})}showRate(){Sn(this.rate,k.view3d.frameRate(this.view?.budget.perSecond()??0))}key(t){if(t.altKey||t.ctrlKey||t.metaKey||this.view===null)return;const e=this.view.cameraMan,n=a=>()=>this.switches[a].click(),s=this.store.view==="trainee",o={ArrowLeft:()=>e.nudge(-Wa,0,1),ArrowRight:()=>e.nudge(Wa,0,1),ArrowUp:()=>e.nudge(0,Wa,1),ArrowDown:()=>e.nudge(0,-Wa,1),"+":()=>e.nudge(0,0,jc),"=":()=>e.nudge(0,0,jc),"-":()=>e.nudge(0,0,1/jc),...s?{}:{x:n("xray"),l:n("lattice"),p:n("particles"),c:n("cut")},...Object.fromEntries(bp.map((a,l)=>[String(l+1),()=>this.view?.preset(a)]))}[t.key];o!==void 0&&(t.preventDefault(),o())}}const Ni=["trainee","teacher","engineer","report"],Ep=i=>i.replace(/\.toml$/,"");class gT{constructor(t,e,n){this.store=t,this.send=e,this.scene=tt("select",{"aria-label":k.session.scene}),this.trainee=tt("input",{type:"text",maxlength:60,autocomplete:"off",placeholder:k.session.trainee,"aria-label":`${k.session.trainee}: ${k.session.traineeHint}`}),this.main=Je("",()=>this.act(),{class:"primary"}),this.reset=Je(k.session.reset,()=>this.send(li.reset())),this.clear=Je(k.session.acknowledge,()=>this.acknowledge(),{class:"warning"}),this.state=tt("span",{class:"activity",role:"status"}),this.clock=tt("span",{class:"clock"}),this.tabs=Ni.map(r=>Je(k.views[r],()=>t.select(r),{role:"tab",id:`tab-${r}`,"aria-controls":"main"}));const s=tt("div",{role:"tablist",class:"tabs","aria-label":k.viewsLabel},...this.tabs);s.addEventListener("keydown",r=>this.walkTabs(r)),this.controls=tt("div",{class:"controls",role:"group","aria-label":k.session.label},this.scene,this.trainee,this.main,this.reset,this.clear),this.root=tt("header",{class:"top"},tt("h1",{},k.brand),s,this.controls,tt("div",{class:"state"},this.state,this.clock),Je(k.help.open,n,{class:"quiet","aria-keyshortcuts":"?"})),this.scene.addEventListener("change",()=>e(li.choose(this.scene.value))),t.on(["hello"],()=>this.begin()),t.on(["frame","link"],()=>this.show()),t.on(["view"],()=>this.showTabs())}act(){const{hello:t,frame:e}=this.store;t===null||!t.mayControl||this.store.playback||(e?.activity===Kn.Running?this.send(li.pause()):e?.activity===Kn.Paused?this.send(li.resume()):this.send(li.start(this.trainee.value.trim())))}acknowledge(){this.store.frame?.needles.forEach((t,e)=>{t.fault!==""&&this.send(li.acknowledge(e,t.fault))})}walkTabs(t){const e=Ni.indexOf(this.store.view),n={ArrowLeft:e-1,ArrowRight:e+1,Home:0,End:Ni.length-1}[t.key];if(n===void 0)return;t.preventDefault();const s=Ni[(n+Ni.length)%Ni.length];this.store.select(s),this.tabs[Ni.indexOf(s)].focus()}begin(){const{hello:t}=this.store;if(t===null)return;const e=t.scenes.includes(t.scene)?t.scenes:[t.scene,...t.scenes];this.scene.replaceChildren(...e.map(s=>tt("option",{value:s},Ep(s)))),this.scene.value=t.scene,this.scene.disabled=t.scenes.length<2||!t.mayControl;const n=!this.store.playback;for(const s of[this.trainee,this.main,this.reset])s.hidden=!n,s.disabled=!t.mayControl,s.title=t.mayControl?"":k.session.watching;document.title=`${Ep(t.scene)} - ${k.title}`,this.show()}show(){const{frame:t,hello:e}=this.store,n=t?.activity??Kn.Ready,s={[Kn.Running]:k.session.pause,[Kn.Paused]:k.session.resume};Sn(this.main,s[n]??k.session.start),Sn(this.state,e===null?k.link.waiting:k.session.activity[n]??""),this.state.dataset.activity=Kn[n],Sn(this.clock,t===null?"":k.units.s(this.store.seconds(t.tick),1)),this.clear.hidden=!e?.mayControl||!t?.needles.some(r=>r.fault!==""),this.trainee.readOnly=n===Kn.Running||n===Kn.Paused}showTabs(){Ni.forEach((t,e)=>{const n=t===this.store.view;this.tabs[e].setAttribute("aria-selected",String(n)),this.tabs[e].tabIndex=n?0:-1})}}const bT=8e3;class vT{constructor(t,e){this.connection=e,this.banner=tt("div",{class:"banner",role:"alert",hidden:!0}),this.notices=tt("div",{class:"notices",role:"status","aria-live":"polite"}),this.words=tt("span"),this.again=Je(k.link.retry,()=>this.act()),this.banner.append(this.words,this.again),t.on(["link"],()=>this.show()),window.setInterval(()=>this.connection().link.state==="waiting"&&this.show(),500)}notice(t){const e=tt("p",{},t);for(this.notices.append(e);this.notices.children.length>3;)this.notices.firstChild?.remove();window.setTimeout(()=>e.remove(),bT)}act(){this.connection().link.state==="closed"?window.location.reload():this.connection().open()}show(){const{link:t}=this.connection(),e=document.body.dataset.seen==="true";t.state==="open"&&(document.body.dataset.seen="true"),document.body.dataset.link=t.state,this.banner.hidden=t.state==="open"||t.state==="connecting"&&!e;const n=(t.retryAt-performance.now())/1e3,s={open:"",connecting:k.link.trying,waiting:k.link.lost(n),closed:k.link.protocol(t.theirs,Ap)}[t.state];Sn(this.words,s),Sn(this.again,t.state==="closed"?k.link.reload:k.link.retry)}}function xT(){const i=k.help.keys.map(([e,n])=>tt("div",{},tt("dt",{},e),tt("dd",{},n))),t=tt("dialog",{"aria-labelledby":"help-heading"},tt("h2",{id:"help-heading"},k.help.heading),tt("dl",{class:"facts"},...i),Je(k.help.close,()=>t.close(),{class:"primary"}));return t}class MT{constructor(){this.hello=null,this.organ=null,this.frame=null,this.moved=new Int16Array,this.series=[],this.events=[],this.marks=[],this.scores=[],this.view="trainee",this.needle=0,this.untold=new Set,this.listeners=new Map}on(t,e){for(const n of t)this.listeners.set(n,[...this.listeners.get(n)??[],e])}tell(t){for(const e of this.listeners.get(t)??[])e()}get playback(){return(this.hello?.recordingTicks??0)>0}get period(){return this.hello?.period??.001}get rows(){return this.series[this.needle]??ST}seconds(t){return t*this.period}layerName(t){return this.organ?.materials[t]??""}take(t){switch(t.kind){case"hello":this.begin(t);break;case"frame":this.advance(t);break;case"rows":for(const e of t.rows)this.series[e.needle]?.add(e);this.addEvents(t.events),this.tell("rows");break;case"score":this.scores=[...this.scores.filter(e=>e.attempt!==t.attempt),t],this.tell("scores");break;case"marked":this.marks=[...this.marks,t].sort((e,n)=>e.tick-n.tick),this.tell("rows");break}}select(t){this.view=t,this.tell("view")}begin(t){const e=this.hello?.scene!==t.scene;this.hello=t,this.moved=new Int16Array(4*t.particles),this.frame=null,this.needle=Math.min(this.needle,t.needles.length-1),this.series=t.needles.map(()=>new zp),this.events=[],e&&(this.marks=[]),this.tell("hello"),this.tell("rows")}advance(t){if(this.hello===null)return;const e=this.frame;!this.playback&&e!==null&&t.tick<e.tick&&this.forget(),this.frame=t,this.move(t);for(const n of t.rows)this.series[n.needle]?.add(n);this.addEvents(t.events),this.untold.add("frame"),(t.rows.length>0||t.events.length>0)&&this.untold.add("rows")}flush(){const t=[...this.untold];this.untold.clear();for(const e of t)this.tell(e)}move(t){const{movedIndex:e,movedTo:n,key:s}=t,r=n.length/3;for(let o=0;o<r;++o){const a=s?o:e[o];if(!(4*a+3>=this.moved.length))for(let l=0;l<3;++l)this.moved[4*a+l]=n[3*o+l]}}forget(){for(const t of this.series)t.clear();this.events=[],this.marks=[],this.tell("rows")}addEvents(t){if(t.length===0)return;const e=r=>`${r.tick} ${r.eventKind} ${r.needle}`,n=new Set(this.events.map(e)),s=t.filter(r=>!n.has(e(r)));this.events=[...this.events,...s].sort((r,o)=>r.tick-o.tick)}}const ST=new zp,we=new MT,zu=new ag(IT,()=>we.tell("link"),()=>_o.notice(k.link.garbled),i=>fr.view?fr.view.budget.time("message",i):i()),na=i=>void zu.send(i),wl=xT(),_o=new vT(we,()=>zu),fr=new _T(we),__=new gT(we,na,()=>wl.showModal()),Vu=new Lb(we,na),g_=i=>Vu.seek(i),yT=new Tg(we),b_=new jb(we,na,g_),wT=new Rb(we,()=>fr.view,()=>b_.drawMs),v_=new sv(we,na,g_),ET=new nv(we,na),TT=new rv(we),AT=new ov(we),RT=new lv(we),PT=tt("div",{class:"side"},...[yT,ET,b_,v_,TT,AT,wT,RT].map(i=>i.root)),x_=tt("main",{id:"main",role:"tabpanel"},fr.root,PT);let Zc=0;async function CT(){const i=++Zc;try{const t=await fetch(Ip("organ",window.location));if(!t.ok)throw new Error(`HTTP ${t.status}`);const e=vg(await t.arrayBuffer());if(i!==Zc||we.hello===null)return;const n=xg(e,we.hello);if(n!=="")throw new Error(n);we.organ=e,we.tell("organ")}catch(t){i===Zc&&_o.notice(k.link.organ(t instanceof Error?t.message:""))}}const LT=100;let M_=0;function S_(){M_=performance.now(),we.flush()}function IT(i){i.kind==="refused"&&_o.notice(i.what),we.take(i),performance.now()-M_>LT&&S_(),i.kind==="hello"&&(we.organ=null,CT())}function FT(i){const t=i.target,e=t.matches("input, select, textarea"),n=i.altKey?Ni[Number(i.key)-1]:void 0;if(n!==void 0){i.preventDefault(),we.select(n);return}e||i.altKey||i.ctrlKey||i.metaKey||wl.open||(i.key==="?"?wl.showModal():i.key===" "&&!t.matches("button, [role=tab]")?(i.preventDefault(),we.playback?Vu.toggle():__.act()):i.key==="m"&&(i.preventDefault(),we.view!=="teacher"&&we.select("teacher"),v_.input.focus()))}document.title=k.title;document.documentElement.lang=k.language;document.body.append(tt("a",{class:"skip",href:"#scene-canvas"},k.skip),__.root,_o.banner,x_,Vu.root,_o.notices,wl);document.addEventListener("keydown",FT);we.on(["view"],()=>{document.body.dataset.view=we.view,x_.setAttribute("aria-labelledby",`tab-${we.view}`)});we.select(Ni.find(i=>i===window.location.hash.slice(1))??"trainee");fr.begin()||_o.notice(k.link.webgl);zu.open();function y_(){requestAnimationFrame(y_),S_(),fr.view?.step()}requestAnimationFrame(y_);Object.assign(window,{stylet:{store:we,view:()=>fr.view}});
