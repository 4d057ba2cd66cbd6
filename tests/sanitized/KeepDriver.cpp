// SPDX-License-Identifier: MIT
// Mesa is unloaded with the last window or display. LeakSanitizer then takes what its globals pointed at for leaks, and cannot
// say whose they are: a program of stock OSG alone has three of them a window. While it is loaded there are none.
#include <dlfcn.h>
#include <link.h>

#include <filesystem>

static const bool driverStaysLoaded = [] {
    dlopen("libEGL_mesa.so.0", RTLD_LAZY | RTLD_NODELETE);
    void* const glx = dlopen("libGLX_mesa.so.0", RTLD_LAZY | RTLD_NODELETE);
    link_map* map = nullptr;
    if (!glx || dlinfo(glx, RTLD_DI_LINKMAP, &map) != 0) return false;  // another vendor's
    const std::filesystem::path driver = std::filesystem::path(map->l_name).parent_path() / "dri/swrast_dri.so";
    return dlopen(driver.c_str(), RTLD_LAZY | RTLD_NODELETE) != nullptr;
}();
