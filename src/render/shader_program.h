#pragma once

#include <array>
#include <cstdint>
#include <epoxy/gl.h>
#include <map>
#include <string>

namespace abut {

/// A linked program of a vertex and a fragment shader.
class ShaderProgram {
public:
    /// In          definitions: lines such as "#define SECTION", put before both sources.
    /// Errors      Error{unsupported} with the driver's message if it does not compile.
    ShaderProgram(const std::string& definitions, const char* vertex, const char* fragment);
    ~ShaderProgram();
    ShaderProgram(const ShaderProgram&) = delete;
    ShaderProgram& operator=(const ShaderProgram&) = delete;

    void use() const { glUseProgram(name_); }

    /// These set a uniform of the program in use. One that the program does not have is ignored.
    void set(const char* name, int value);
    void set(const char* name, float value);
    void set(const char* name, const std::array<float, 2>& value);
    void set(const char* name, const std::array<float, 3>& value);
    void set(const char* name, const std::array<float, 4>& value);
    void set_matrix(const char* name, const std::array<float, 16>& column_major);
    void set_array(const char* name, const float* vec4s, int count);

private:
    GLint place(const char* name);

    GLuint name_ = 0;
    std::map<std::string, GLint, std::less<>> places_;
};

} // namespace abut
