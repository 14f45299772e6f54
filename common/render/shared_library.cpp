#include "common/render/shared_library.h"

#include <dlfcn.h>

namespace swath {

Result<SharedLibrary> SharedLibrary::load(const char* soname) {
    // Local, because OSMesa and EGL bring functions of the same names.
    void* const handle = ::dlopen(soname, RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) return fail("{}", ::dlerror());
    return SharedLibrary(handle);
}

void* SharedLibrary::find(const char* name) const { return ::dlsym(handle_, name); }

}  // namespace swath
