#include "render/shader_program.h"

#include <abut/error.h>

#include <algorithm>

namespace abut {

namespace {

/// The first line of a driver's message.
std::string first_line(std::string message) {
    message.resize(std::min(message.find_first_of("\n\0"), message.size()));
    return message;
}

GLuint compile_shader(GLenum kind, const std::string& definitions, const char* source) {
    const std::string head = "#version 330 core\n" + definitions;
    const char* const texts[] = {head.c_str(), source};
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 2, texts, nullptr);
    glCompileShader(shader);
    GLint done = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done == GL_TRUE)
        return shader;
    std::string message(1000, '\0');
    glGetShaderInfoLog(shader, static_cast<GLsizei>(message.size()), nullptr, message.data());
    glDeleteShader(shader);
    throw Error(ErrorCode::unsupported, "OpenGL refuses a shader: " + first_line(message));
}

} // namespace

ShaderProgram::ShaderProgram(const std::string& definitions, const char* vertex,
                             const char* fragment)
    : name_(glCreateProgram()) {
    const GLuint a = compile_shader(GL_VERTEX_SHADER, definitions, vertex);
    const GLuint b = compile_shader(GL_FRAGMENT_SHADER, definitions, fragment);
    glAttachShader(name_, a);
    glAttachShader(name_, b);
    glLinkProgram(name_);
    glDeleteShader(a);
    glDeleteShader(b);
    GLint done = GL_FALSE;
    glGetProgramiv(name_, GL_LINK_STATUS, &done);
    if (done == GL_TRUE)
        return;
    std::string message(1000, '\0');
    glGetProgramInfoLog(name_, static_cast<GLsizei>(message.size()), nullptr, message.data());
    glDeleteProgram(name_);
    throw Error(ErrorCode::unsupported, "OpenGL refuses a program: " + first_line(message));
}

ShaderProgram::~ShaderProgram() {
    glDeleteProgram(name_);
}

GLint ShaderProgram::place(const char* name) {
    const auto found = places_.find(name);
    if (found != places_.end())
        return found->second;
    return places_.emplace(name, glGetUniformLocation(name_, name)).first->second;
}

void ShaderProgram::set(const char* name, int value) {
    glUniform1i(place(name), value);
}
void ShaderProgram::set(const char* name, float value) {
    glUniform1f(place(name), value);
}
void ShaderProgram::set(const char* name, const std::array<float, 2>& value) {
    glUniform2fv(place(name), 1, value.data());
}
void ShaderProgram::set(const char* name, const std::array<float, 3>& value) {
    glUniform3fv(place(name), 1, value.data());
}
void ShaderProgram::set(const char* name, const std::array<float, 4>& value) {
    glUniform4fv(place(name), 1, value.data());
}
void ShaderProgram::set_matrix(const char* name, const std::array<float, 16>& column_major) {
    glUniformMatrix4fv(place(name), 1, GL_FALSE, column_major.data());
}
void ShaderProgram::set_array(const char* name, const float* vec4s, int count) {
    glUniform4fv(place(name), count, vec4s);
}

} // namespace abut
