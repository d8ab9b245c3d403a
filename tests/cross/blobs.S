/* SPDX-License-Identifier: Apache-2.0
   The organ and the recorded insertions as constants: in flash where there is flash. The folder with
   the files is on the assembler's include path. WebAssembly wants the type and size of each. */
#if defined(__wasm__)
#define DATA @object
.section .rodata, "", @
#else
#define DATA %object
.section .rodata
#endif

.macro blob name, file
  .balign 64
  .global \name
  .type \name, DATA
  \name:
  .incbin "\file"
  .size \name, . - \name
  .global \name\()_end
  .type \name\()_end, DATA
  \name\()_end:
  .byte 0
  .size \name\()_end, 1
.endm

blob blob_organ, organ.bin
blob blob_physical, physical.bin
blob blob_paper, paper.bin
blob blob_elastic, elastic.bin
blob blob_added_mass, added_mass.bin
blob blob_stiffening_organ, stiffening_organ.bin
blob blob_stiffening, stiffening.bin
blob blob_sliding_organ, sliding_organ.bin
blob blob_sliding, sliding.bin
#if defined(__linux__)
.section .note.GNU-stack, "", %progbits
#endif
