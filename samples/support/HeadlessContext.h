// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/** An OpenGL compatibility context without an X server, through EGL, current in the thread that made it. */
class HeadlessContext
{
  public:
    /** Throws std::runtime_error that says which step of EGL failed. */
    HeadlessContext();
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    /** GL_RENDERER and GL_VERSION. */
    std::string renderer() const;
    std::string version() const;

  private:
    void* _display = nullptr;
    void* _surface = nullptr;
    void* _context = nullptr;
};
