#pragma once

#include <string>
#include <vector>

namespace regrasp {

/// A shared library that is loaded when it is first needed and stays loaded.
///
/// The libraries that draw and encode take longer to load than most runs of a program that writes
/// no picture: OSMesa with LLVM 40 ms, libavformat with 130 others 50 ms of processor time.
class SharedLibrary {
 public:
  /// @param names  file names to try in this order, such as "libOSMesa.so.8".
  /// @throws EnvironmentError  if none can be loaded.
  explicit SharedLibrary(const std::vector<std::string>& names);

  /// Set `function` to the function of this name.
  /// @throws EnvironmentError  if the library has no such function.
  template <class Function>
  void Find(const char* name, Function*& function) const {
    function = reinterpret_cast<Function*>(Find(name));
  }

 private:
  [[nodiscard]] void* Find(const char* name) const;

  std::string name_;
  void* handle_ = nullptr;
};

}  // namespace regrasp
