// SPDX-License-Identifier: MIT
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include "GlContext.h"

#include <stdexcept>

#include "gl/ShaderLibrary.h"

namespace
{

std::string logOf(GLuint shader)
{
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) return std::string();
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader, GLsizei(log.size()), &length, log.data());
    log.resize(size_t(length));
    return log.empty() ? "does not compile, no log" : log;
}

GLuint makeShader(GLenum type, const std::string& text)
{
    const GLuint shader = glCreateShader(type);
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    return shader;
}

void makeTexture(GLuint texture, int width, int height, const float* texels, bool linear)
{
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, texels);
    const GLint filter = linear ? GL_LINEAR : GL_NEAREST;
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

GLuint makeProgram(const std::string& vertex, const std::string& fragment)
{
    const GLuint program = glCreateProgram();
    std::string log;
    for (GLuint shader : {makeShader(GL_VERTEX_SHADER, vertex), makeShader(GL_FRAGMENT_SHADER, fragment)}) {
        log += logOf(shader);
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked) return program;
    std::string linkLog(4096, '\0');
    GLsizei length = 0;
    glGetProgramInfoLog(program, GLsizei(linkLog.size()), &length, linkLog.data());
    glDeleteProgram(program);
    throw std::runtime_error("does not link: " + log + linkLog.substr(0, size_t(length)));
}

void drawTriangle()
{
    glBegin(GL_TRIANGLES);
    glVertex2f(-1.0f, -1.0f);
    glVertex2f(3.0f, -1.0f);
    glVertex2f(-1.0f, 3.0f);
    glEnd();
}

}  // namespace

GlContext::GlContext() = default;

std::string GlContext::link(const std::string& vertex, const std::string& fragment) const
{
    try {
        glDeleteProgram(makeProgram(vertex, fragment));
        return std::string();
    } catch (const std::runtime_error& e) {
        return e.what();
    }
}

std::vector<float> GlContext::render(const std::string& fragment, int width, int height,
                                     const std::vector<Texture>& textures) const
{
    const GLuint program =
        makeProgram("#version 330 compatibility\nvoid main() { gl_Position = vec4(gl_Vertex.xy, 0.0, 1.0); }\n", fragment);
    glUseProgram(program);
    std::vector<GLuint> names(textures.size() + 1);
    glGenTextures(GLsizei(names.size()), names.data());
    makeTexture(names[0], width, height, nullptr, false);
    GLuint target = 0;
    glGenFramebuffers(1, &target);
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, names[0], 0);
    for (size_t i = 0; i < textures.size(); ++i) {
        glActiveTexture(GLenum(GL_TEXTURE0 + i));
        makeTexture(names[i + 1], textures[i].width, textures[i].height, textures[i].texels.data(), textures[i].linear);
        glUniform1i(glGetUniformLocation(program, textures[i].name.c_str()), GLint(i));
    }
    glViewport(0, 0, width, height);
    drawTriangle();
    std::vector<float> result(size_t(4 * width * height));
    glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, result.data());
    const GLenum error = glGetError();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &target);
    glDeleteTextures(GLsizei(names.size()), names.data());
    glUseProgram(0);
    glDeleteProgram(program);
    glActiveTexture(GL_TEXTURE0);
    if (error != GL_NO_ERROR) throw std::runtime_error("OpenGL error " + std::to_string(error) + " in a test's drawing");
    return result;
}

std::vector<glm::vec4> GlContext::evaluate(const std::vector<std::string>& files, const std::string& body,
                                           const std::vector<std::vector<glm::vec4>>& inputs,
                                           const std::vector<Texture>& textures) const
{
    const osg::ref_ptr<osgEnvLight::ShaderLibrary> library = new osgEnvLight::ShaderLibrary(nullptr);
    const size_t count = inputs.at(0).size();
    const int width = 64;
    const int height = int((count + 63) / 64);
    // Every BRDF, as in glsl.h.
    std::string text =
        "#version 330 compatibility\n#define HAS_PHONG\n#define HAS_COOK_TORRANCE\n"
        "#define HAS_BLINN_PHONG\n#define HAS_BECKMANN\n#define HAS_STRAUSS\n";
    for (const std::string& file : files) text += library->expand(file).text;
    std::string fetches;
    std::vector<Texture> all = textures;
    for (size_t k = 0; k < inputs.size(); ++k) {
        const std::string letter(1, char('a' + k));
        text += "uniform sampler2D input_" + letter + ";\n";
        fetches += "    vec4 " + letter + " = texelFetch(input_" + letter + ", ivec2(gl_FragCoord.xy), 0);\n";
        Texture t{"input_" + letter, width, height, std::vector<float>(size_t(4 * width * height))};
        for (size_t i = 0; i < count; ++i)
            for (int c = 0; c < 4; ++c) t.texels[4 * i + size_t(c)] = inputs[k].at(i)[c];
        all.push_back(t);
    }
    for (const Texture& t : textures) text += "uniform sampler2D " + t.name + ";\n";
    text += "out vec4 result;\nvoid main()\n{\n" + fetches + body + "\n}\n";
    const std::vector<float> pixels = render(text, width, height, all);
    std::vector<glm::vec4> result;
    for (size_t i = 0; i < count; ++i)
        result.emplace_back(pixels[4 * i], pixels[4 * i + 1], pixels[4 * i + 2], pixels[4 * i + 3]);
    return result;
}
