#include "experiment/pictures/plain_png.h"

#include <csetjmp>

#include <png.h>
#include <zlib.h>

namespace overt {

namespace {

constexpr char colour_space[] = "oiio:ColorSpace";

bool is_plain(const PictureHeader& header, PixelType type) {
    return header.type == PixelType::bits8 && type == PixelType::bits8 &&
           header.channels == std::vector<std::string>{"R", "G", "B"} && header.alpha_channel < 0 &&
           header.attributes.size() == 1 && header.text(colour_space) == "sRGB" && header.size_px.x > 0 &&
           header.size_px.y > 0;
}

/// Jumps back to where the file is begun if something fails: nothing that would have to be destroyed may be
/// made here.
bool write_rows(png_struct* png, png_info* info, glm::ivec2 size_px, const unsigned char* rgb,
                std::vector<unsigned char>& bytes) {
    if (setjmp(png_jmpbuf(png)) != 0)
        return false;
    png_set_write_fn(
        png, &bytes,
        [](png_struct* writer, unsigned char* written, std::size_t count) {
            auto& all = *static_cast<std::vector<unsigned char>*>(png_get_io_ptr(writer));
            all.insert(all.end(), written, written + count);
        },
        nullptr);
    const auto width = static_cast<png_uint_32>(size_px.x), height = static_cast<png_uint_32>(size_px.y);
    // As OpenImageIO has them.
    png_set_compression_level(png, 6);
    png_set_compression_strategy(png, Z_DEFAULT_STRATEGY);
    png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_oFFs(png, info, 0, 0, PNG_OFFSET_PIXEL);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
    char name[] = "oiio:ColorSpace", value[] = "sRGB";
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = name;
    text.text = value;
    text.text_length = sizeof value - 1;
    png_set_text(png, info, &text, 1);
    png_write_info(png, info);
    for (png_uint_32 row = 0; row < height; ++row)
        png_write_row(png, rgb + std::size_t{3} * width * row);
    png_write_end(png, info);
    return true;
}

} // namespace

std::optional<std::vector<unsigned char>> encode_srgb_png(const PictureHeader& header, PixelType type,
                                                          const void* rgb) {
    if (!is_plain(header, type))
        return std::nullopt;
    std::vector<unsigned char> bytes;
    png_struct* png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_info* info = png ? png_create_info_struct(png) : nullptr;
    const bool is_written =
        info && write_rows(png, info, header.size_px, static_cast<const unsigned char*>(rgb), bytes);
    png_destroy_write_struct(&png, &info);
    return is_written ? std::optional(std::move(bytes)) : std::nullopt;
}

} // namespace overt
