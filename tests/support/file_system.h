// SPDX-License-Identifier: Apache-2.0
// File systems that can do less: NFS and FUSE cannot exchange two files or refuse to replace one;
// FAT, and folders that a virtual machine shares, know no second names. A program that links this
// calls it in the system's place (renameat2, link), and is refused as those refuse.
#pragma once

namespace stylet::test {

// As long as one of these lives; one at a time.
class FileSystem {
 public:
  // Exchanges two files, or refuses to replace one; gives a file a second name.
  FileSystem(bool exchanges, bool links);
  ~FileSystem();
  FileSystem(const FileSystem&) = delete;
  FileSystem& operator=(const FileSystem&) = delete;
};

}  // namespace stylet::test
