#pragma once

#include <string>
#include <vector>

namespace regrasp {

/// Shared library that is loaded on first use and stays loaded.
///
/// The libraries for rendering and encoding take longer to load than most runs of a program that
/// writes no image: OSMesa with LLVM 40 ms, libavformat with 130 others 50 ms of processor time.
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
