#include "experiment/scene/files/picture_bytes.h"

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/pictures/picture_file.h"

namespace overt {

std::string_view format_of_picture(std::string_view bytes) {
    using namespace std::string_view_literals;
    if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv))
        return "png";
    if (bytes.starts_with("\xff\xd8\xff"sv))
        return "jpeg";
    if (bytes.starts_with("\xabKTX"sv))
        return "KTX2";
    if (bytes.starts_with("RIFF"sv) && bytes.substr(0, 12).ends_with("WEBP"sv))
        return "webp";
    if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv))
        return "TIFF";
    if (bytes.starts_with("BM"sv))
        return "BMP";
    if (bytes.starts_with("DDS "sv))
        return "DDS";
    return {};
}

namespace {

/// Of an extended WebP ("VP8X"): its reader makes room for the whole canvas before anything else. Others have
/// sides below 16384 px.
void expect_small_canvas(std::string_view bytes, const std::string& name) {
    constexpr std::size_t sides_at = 24;
    if (bytes.substr(0, 16).substr(12) != "VP8X" || bytes.size() < sides_at + 6)
        return;
    const auto side_at = [&](std::size_t at) {
        std::uint64_t side = 1;
        for (std::size_t i = 0; i < 3; ++i)
            side += std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
        return side;
    };
    const std::uint64_t width = side_at(sides_at), height = side_at(sides_at + 3);
    constexpr std::uint64_t most_side = most_picture_side_px, most_pixels = most_picture_bytes / 16;
    if (width > most_side || height > most_side || width * height > most_pixels)
        throw InputError(
            fmt::format("{}: this picture claims {} x {} px, more than is read.", name, width, height));
}

} // namespace

std::shared_ptr<const SurfacePicture> read_surface_picture(std::string_view bytes, const std::string& name,
                                                           std::string file_name) {
    const std::string_view format = format_of_picture(bytes);
    if (format != "png" && format != "jpeg" && format != "webp")
        throw InputError(
            fmt::format("{}: this picture is {}; overt reads PNG, JPEG and WebP on surfaces: convert it to "
                        "PNG.",
                        name, format.empty() ? "of no format that is known" : std::string(format)));
    if (format == "webp")
        expect_small_canvas(bytes, name);
    PictureFile file(bytes, std::string(format), name, "picture", StraightColours::as_they_stand);
    const PictureHeader& header = file.header();
    const int channels = header.channel_count();
    if (channels > 4)
        throw InputError(
            fmt::format("{}: this picture has {} channels; one to four are read.", name, channels));
    if (format == "webp" && channels == 4)
        throw InputError(
            fmt::format("{}: this picture is WebP with alpha, by which its reader changes colours: "
                        "convert it to PNG.",
                        name));
    auto picture = std::make_shared<SurfacePicture>();
    picture->name = name;
    picture->file = std::move(file_name);
    picture->size_px = header.size_px;
    const std::size_t pixels =
        static_cast<std::size_t>(header.size_px.x) * static_cast<std::size_t>(header.size_px.y);
    std::vector<std::uint8_t> codes(pixels * static_cast<std::size_t>(channels));
    file.read(channels, PixelType::bits8, codes.data());
    picture->texels.reserve(pixels);
    const std::uint8_t* code = codes.data();
    for (std::size_t i = 0; i < pixels; ++i, code += channels) {
        switch (channels) {
        case 1:
            picture->texels.emplace_back(code[0], code[0], code[0], 255);
            break;
        case 2:
            picture->texels.emplace_back(code[0], code[0], code[0], code[1]);
            break;
        case 3:
            picture->texels.emplace_back(code[0], code[1], code[2], 255);
            break;
        default:
            picture->texels.emplace_back(code[0], code[1], code[2], code[3]);
        }
    }
    return picture;
}

} // namespace overt
