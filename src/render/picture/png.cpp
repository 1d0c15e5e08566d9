#include <abut/error.h>
#include <abut/picture.h>

#include "core/atomic_file.h"

#include <csetjmp>
#include <png.h>

namespace abut {

namespace {

void append_png(png_structp png, png_bytep bytes, png_size_t count) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(bytes), count);
}

/// Returns false if libpng fails. It returns by longjmp, so nothing here has a destructor.
bool encode_png(const Picture& picture, std::string& file) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    if (info == nullptr || setjmp(png_jmpbuf(png)) != 0) { // NOLINT: the way of libpng
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_set_write_fn(png, &file, append_png, nullptr);
    png_set_IHDR(png, info, picture.width, picture.height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png, 6);
    png_write_info(png, info);
    for (std::size_t y = 0; y < picture.height; ++y)
        png_write_row(png, picture.pixels.data() + y * picture.width * 3);
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return true;
}

} // namespace

std::string png_bytes(const Picture& picture) {
    if (picture.width == 0 || picture.height == 0 ||
        picture.pixels.size() != std::size_t{picture.width} * picture.height * 3)
        throw Error(ErrorCode::bad_argument, "a picture without pixels cannot be written");
    std::string file;
    if (!encode_png(picture, file))
        throw Error(ErrorCode::cannot_write, "a picture cannot be encoded as PNG");
    return file;
}

void write_png(const Picture& picture, const std::string& path) {
    write_file_atomically(path, png_bytes(picture));
}

} // namespace abut
