// SPDX-License-Identifier: MIT
#include "FileDrop.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <chrono>
#include <thread>

namespace
{

class DragSource
{
  public:
    DragSource(const std::string& display, Window target, const std::string& file)
        : _display(XOpenDisplay(display.c_str())), _target(target), _uri("file://" + file + "\r\n")
    {
        if (!_display) return;
        _window = XCreateSimpleWindow(_display, DefaultRootWindow(_display), 0, 0, 1, 1, 0, 0, 0);
        XSetSelectionOwner(_display, atom("XdndSelection"), _window, CurrentTime);
    }
    ~DragSource()
    {
        if (_display) XCloseDisplay(_display);
    }
    DragSource(const DragSource&) = delete;
    DragSource& operator=(const DragSource&) = delete;

    bool drop()
    {
        if (!_display) return false;
        const long version = 5;
        const long middle = 40 << 16 | 40;
        send("XdndEnter", version << 24, long(atom("text/uri-list")), 0, 0);
        send("XdndPosition", 0, middle, CurrentTime, long(atom("XdndActionCopy")));
        if (!await("XdndStatus")) return false;
        send("XdndDrop", 0, CurrentTime, 0, 0);
        return await("XdndFinished");
    }

  private:
    Atom atom(const char* name) const { return XInternAtom(_display, name, False); }

    void send(const char* type, long a, long b, long c, long d)
    {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = _target;
        event.xclient.message_type = atom(type);
        event.xclient.format = 32;
        const long data[] = {long(_window), a, b, c, d};
        for (int i = 0; i < 5; ++i) event.xclient.data.l[i] = data[i];
        XSendEvent(_display, _target, False, NoEventMask, &event);
        XFlush(_display);
    }

    // Whether the window's answer of that type says yes (GLFW's last one is a number of bytes); meanwhile it may ask for the
    // file's name.
    bool await(const char* type)
    {
        for (int i = 0; i < 600; ++i) {
            while (XPending(_display)) {
                XEvent event;
                XNextEvent(_display, &event);
                if (event.type == SelectionRequest) give(event.xselectionrequest);
                if (event.type == ClientMessage && event.xclient.message_type == atom(type)) return event.xclient.data.l[1] != 0;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        return false;
    }

    void give(const XSelectionRequestEvent& request)
    {
        XChangeProperty(_display, request.requestor, request.property, request.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(_uri.data()), int(_uri.size()));
        XEvent event{};
        event.xselection.type = SelectionNotify;
        event.xselection.requestor = request.requestor;
        event.xselection.selection = request.selection;
        event.xselection.target = request.target;
        event.xselection.property = request.property;
        event.xselection.time = request.time;
        XSendEvent(_display, request.requestor, False, NoEventMask, &event);
        XFlush(_display);
    }

    Display* _display;
    Window _target;
    Window _window = 0;
    std::string _uri;
};

}  // namespace

bool dropFile(const std::string& display, unsigned long window, const std::string& file)
{
    return DragSource(display, window, file).drop();
}
