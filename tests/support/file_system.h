// SPDX-License-Identifier: Apache-2.0
// File systems that can do less: NFS and FUSE cannot exchange two files or refuse to replace one;
// FAT, and folders that a virtual machine shares, have no hard links. A program that links this
// calls it instead of the system (renameat2, link), and is refused as those would refuse.
#pragma once

namespace stylet::test {

// In force as long as one of these lives; one at a time.
class FileSystem {
 public:
  // Whether it exchanges two files, refuses to replace one, and makes hard links.
  FileSystem(bool exchanges, bool links);
  ~FileSystem();
  FileSystem(const FileSystem&) = delete;
  FileSystem& operator=(const FileSystem&) = delete;
};

}  // namespace stylet::test
