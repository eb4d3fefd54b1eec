#include "planner/base/shared_library.h"

#include <dlfcn.h>

#include "planner/base/error.h"

namespace regrasp {

namespace {

/// Return the loader's description of its last error.
std::string LoaderError() {
  const char* text = dlerror();
  return text == nullptr ? "cannot be loaded" : text;
}

}  // namespace

SharedLibrary::SharedLibrary(const std::vector<std::string>& names) {
  std::string error;
  for (const std::string& name : names) {
    name_ = name;
    handle_ = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle_ != nullptr) return;
    error = LoaderError();
  }
  throw EnvironmentError("shared library: " + error);
}

void* SharedLibrary::Find(const char* name) const {
  void* symbol = dlsym(handle_, name);
  if (symbol == nullptr) throw EnvironmentError(name_ + ": function " + name + " not found");
  return symbol;
}

}  // namespace regrasp
