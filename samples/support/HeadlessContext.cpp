// SPDX-License-Identifier: MIT
#include "HeadlessContext.h"

#include <cstring>
#include <stdexcept>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>

namespace
{

[[noreturn]] void fail(const char* step)
{
    throw std::runtime_error(std::string("no headless OpenGL: ") + step + " failed (EGL error " + std::to_string(eglGetError()) +
                             "); a driver with EGL is needed, such as Mesa (libegl1, libgl1-mesa-dri)");
}

bool hasExtension(const char* list, const char* name)
{
    return list && std::strstr(list, name);
}

// A device of its own first (a GPU without a display server), then Mesa without a surface, then the default.
EGLDisplay openDisplay()
{
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    auto getPlatform = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    auto queryDevices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    if (getPlatform && queryDevices && hasExtension(client, "EGL_EXT_platform_device")) {
        EGLDeviceEXT device = nullptr;
        EGLint count = 0;
        if (queryDevices(1, &device, &count) && count > 0) {
            EGLDisplay display = getPlatform(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
            if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
        }
    }
    if (getPlatform && hasExtension(client, "EGL_MESA_platform_surfaceless")) {
        EGLDisplay display = getPlatform(EGL_PLATFORM_SURFACELESS_MESA, reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr);
        if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr)) return display;
    }
    EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) fail("eglInitialize");
    return display;
}

}  // namespace

HeadlessContext::HeadlessContext() : _display(openDisplay())
{
    if (!eglBindAPI(EGL_OPENGL_API)) fail("eglBindAPI(EGL_OPENGL_API)");
    const EGLint configAttributes[] = {EGL_SURFACE_TYPE,
                                       EGL_PBUFFER_BIT,
                                       EGL_RENDERABLE_TYPE,
                                       EGL_OPENGL_BIT,
                                       EGL_RED_SIZE,
                                       8,
                                       EGL_GREEN_SIZE,
                                       8,
                                       EGL_BLUE_SIZE,
                                       8,
                                       EGL_ALPHA_SIZE,
                                       8,
                                       EGL_DEPTH_SIZE,
                                       24,
                                       EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(_display, configAttributes, &config, 1, &count) || count < 1) fail("eglChooseConfig");
    const EGLint contextAttributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                        3,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        3,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                                        EGL_NONE};
    _context = eglCreateContext(_display, config, EGL_NO_CONTEXT, contextAttributes);
    if (!_context) fail("eglCreateContext for OpenGL 3.3, compatibility profile,");
    // Without a surface OSG's first look at frame buffer 0 is an error of OpenGL.
    const EGLint surfaceAttributes[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
    _surface = eglCreatePbufferSurface(_display, config, surfaceAttributes);
    if (!_surface) fail("eglCreatePbufferSurface");
    if (!eglMakeCurrent(_display, _surface, _surface, _context)) fail("eglMakeCurrent");
}

HeadlessContext::~HeadlessContext()
{
    eglMakeCurrent(_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroySurface(_display, _surface);
    eglDestroyContext(_display, _context);
    // The display is the process's: terminating it would end other contexts on it.
}

std::string HeadlessContext::renderer() const
{
    return reinterpret_cast<const char*>(glGetString(GL_RENDERER));
}

std::string HeadlessContext::version() const
{
    return reinterpret_cast<const char*>(glGetString(GL_VERSION));
}
