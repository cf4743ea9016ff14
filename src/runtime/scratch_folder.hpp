/// A folder that is gone when nobody needs it any more.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>
#include <system_error>

#include "vantage/core/atomic_file.hpp"
#include "vantage/core/error.hpp"

namespace vantage {

class ScratchFolder {
 public:
  /// Below the system's folder for such. @throws OutputError
  ScratchFolder() {
    std::string name = (temporary_place() / "vantage-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw OutputError(name + ": cannot be made");
    path_ = name;
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace vantage
