#pragma once
#include "common/base/result.h"

namespace swath {

// A library that is loaded at run time, because not every machine has it. It stays loaded until the process
// ends: Mesa's threads use its code for longer than its callers do. A value; any thread may use it.
class SharedLibrary {
  public:
    // `soname` as the system's loader finds it. Fails with the loader's reason.
    static Result<SharedLibrary> load(const char* soname);

    // The library's function of that name, whose type is the caller's word. False when there is none.
    template <class Function>
    bool bind(const char* name, Function*& function) const {
        function = reinterpret_cast<Function*>(find(name));
        return function != nullptr;
    }

  private:
    explicit SharedLibrary(void* handle) : handle_(handle) {}
    void* find(const char* name) const;
    void* handle_;
};

}  // namespace swath
