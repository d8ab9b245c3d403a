/* SPDX-License-Identifier: Apache-2.0
   The organ and the recorded insertions as constants: in flash where there is flash. The folder with
   the files is on the assembler's include path. */
.macro blob name, file
  .balign 64
  .global \name
  \name:
  .incbin "\file"
  .global \name\()_end
  \name\()_end:
.endm

.section .rodata
blob blob_organ, organ.bin
blob blob_physical, physical.bin
blob blob_paper, paper.bin
blob blob_elastic, elastic.bin
blob blob_added_mass, added_mass.bin
#if defined(__linux__)
.section .note.GNU-stack, "", %progbits
#endif
