// SPDX-License-Identifier: MIT
#include "GlfwWindow.h"

#include <osgGA/GUIEventAdapter>

#include <stdexcept>
#include <utility>

#include <GLFW/glfw3.h>

namespace
{

using HostEvent = osgGA::GUIEventAdapter;

GlfwWindow& of(GLFWwindow* window)
{
    return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
}

[[noreturn]] void fail(const char* what)
{
    const char* reason = nullptr;
    glfwGetError(&reason);
    throw std::runtime_error(std::string(what) + " can't be had" + (reason ? std::string(": ") + reason : ""));
}

// Keys that type no character; 0 for those that do, and for others.
int symbolOf(int key)
{
    static const std::pair<int, int> symbols[] = {
        {GLFW_KEY_ESCAPE, HostEvent::KEY_Escape},   {GLFW_KEY_TAB, HostEvent::KEY_Tab},
        {GLFW_KEY_ENTER, HostEvent::KEY_Return},    {GLFW_KEY_HOME, HostEvent::KEY_Home},
        {GLFW_KEY_END, HostEvent::KEY_End},         {GLFW_KEY_LEFT, HostEvent::KEY_Left},
        {GLFW_KEY_RIGHT, HostEvent::KEY_Right},     {GLFW_KEY_UP, HostEvent::KEY_Up},
        {GLFW_KEY_DOWN, HostEvent::KEY_Down},       {GLFW_KEY_DELETE, HostEvent::KEY_Delete},
        {GLFW_KEY_PAGE_UP, HostEvent::KEY_Page_Up}, {GLFW_KEY_PAGE_DOWN, HostEvent::KEY_Page_Down},
    };
    for (const auto& [glfw, osg] : symbols)
        if (glfw == key) return osg;
    return key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12 ? HostEvent::KEY_F1 + (key - GLFW_KEY_F1) : 0;
}

int buttonOf(int glfw)
{
    return glfw == GLFW_MOUSE_BUTTON_LEFT ? 1 : glfw == GLFW_MOUSE_BUTTON_MIDDLE ? 2 : glfw == GLFW_MOUSE_BUTTON_RIGHT ? 3 : 0;
}

GLFWwindow* openWindow(int width, int height, const std::string& title)
{
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_COMPAT_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    GLFWwindow* window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (!window) fail("a window with OpenGL 3.3 in the compatibility profile");
    return window;
}

}  // namespace

GlfwWindow::Library::Library()
{
    if (!glfwInit()) fail("a display");
}

GlfwWindow::Library::~Library()
{
    glfwTerminate();
}

GlfwWindow::GlfwWindow(int width, int height, const std::string& title) : _window(openWindow(width, height, title))
{
    glfwSetWindowUserPointer(_window, this);
    glfwMakeContextCurrent(_window);
    glfwSwapInterval(1);
    glfwGetFramebufferSize(_window, &_width, &_height);
    installCallbacks();
}

GlfwWindow::~GlfwWindow()
{
    glfwDestroyWindow(_window);
}

void GlfwWindow::installCallbacks()
{
    glfwSetFramebufferSizeCallback(_window, [](GLFWwindow* w, int width, int height) {
        of(w)._width = width;
        of(w)._height = height;
        of(w)._events.emplace_back();
    });
    glfwSetWindowRefreshCallback(_window, [](GLFWwindow* w) { of(w)._events.emplace_back(); });
    glfwSetKeyCallback(_window, keyChanged);
    glfwSetCharCallback(_window, [](GLFWwindow* w, unsigned character) { of(w).addKey(int(character), false); });
    glfwSetMouseButtonCallback(_window, [](GLFWwindow* w, int button, int action, int modifiers) {
        InputEvent event = of(w).pointerEvent(action == GLFW_RELEASE ? InputEvent::RELEASE : InputEvent::PRESS);
        event.button = buttonOf(button);
        event.shift = modifiers & GLFW_MOD_SHIFT;
        event.control = modifiers & GLFW_MOD_CONTROL;
        if (event.button > 0) of(w)._events.push_back(event);
    });
    glfwSetCursorPosCallback(_window, [](GLFWwindow* w, double x, double y) {
        of(w)._pointerX = x;
        of(w)._pointerY = y;
        of(w)._events.push_back(of(w).pointerEvent(InputEvent::MOVE));
    });
    glfwSetScrollCallback(_window, [](GLFWwindow* w, double x, double y) {
        InputEvent event;
        event.type = InputEvent::SCROLL;
        event.x = x;
        event.y = y;
        of(w)._events.push_back(event);
    });
    glfwSetDropCallback(_window, [](GLFWwindow* w, int count, const char** names) {
        InputEvent event;
        event.type = InputEvent::DROP;
        event.files.assign(names, names + count);
        of(w)._events.push_back(event);
    });
}

// What types a character comes as that character instead, whatever the layout of the keyboard; with Control it types none.
void GlfwWindow::keyChanged(GLFWwindow* window, int key, int scancode, int action, int modifiers)
{
    of(window)._repeats = action == GLFW_REPEAT;
    if (action == GLFW_RELEASE) return;
    const bool control = modifiers & GLFW_MOD_CONTROL;
    if (const int symbol = symbolOf(key)) {
        of(window).addKey(symbol, control);
    } else if (control) {
        const char* name = glfwGetKeyName(key, scancode);
        if (name && name[0] && !name[1]) of(window).addKey(name[0], true);
    }
}

void GlfwWindow::addKey(int key, bool control)
{
    InputEvent event;
    event.type = InputEvent::KEY;
    event.key = key;
    event.repeated = _repeats;
    event.control = control;
    _events.push_back(event);
}

InputEvent GlfwWindow::pointerEvent(InputEvent::Type type) const
{
    InputEvent event;
    event.type = type;
    event.x = _pointerX * double(pixelsPerUnit());
    event.y = _pointerY * double(pixelsPerUnit());
    return event;
}

bool GlfwWindow::isShown() const
{
    return _width > 0 && _height > 0 && !glfwGetWindowAttrib(_window, GLFW_ICONIFIED);
}

float GlfwWindow::contentScale() const
{
    float x = 1.0f, y = 1.0f;
    glfwGetWindowContentScale(_window, &x, &y);
    return x;
}

float GlfwWindow::pixelsPerUnit() const
{
    int width = 0, height = 0;
    glfwGetWindowSize(_window, &width, &height);
    return width > 0 && _width > 0 ? float(_width) / float(width) : 1.0f;
}

std::vector<InputEvent> GlfwWindow::takeEvents(double seconds)
{
    if (seconds > 0.0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
    return std::exchange(_events, {});
}

void GlfwWindow::swap()
{
    glfwSwapBuffers(_window);
}

void GlfwWindow::setTitle(const std::string& title)
{
    glfwSetWindowTitle(_window, title.c_str());
}

void GlfwWindow::setClipboard(const std::string& text)
{
    glfwSetClipboardString(_window, text.c_str());
}

void GlfwWindow::toggleFullScreen()
{
    if (glfwGetWindowMonitor(_window)) {
        glfwSetWindowMonitor(_window, nullptr, _windowed.x, _windowed.y, _windowed.width, _windowed.height, GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (!mode) return;
    glfwGetWindowPos(_window, &_windowed.x, &_windowed.y);
    glfwGetWindowSize(_window, &_windowed.width, &_windowed.height);
    glfwSetWindowMonitor(_window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

bool GlfwWindow::isClosing() const
{
    return glfwWindowShouldClose(_window);
}

void GlfwWindow::close()
{
    glfwSetWindowShouldClose(_window, GLFW_TRUE);
}
