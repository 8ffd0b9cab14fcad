#include "experiment/pictures/picture_file.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "experiment/pictures/picture_library.h"
#include "experiment/pictures/plain_exr.h"
#include "experiment/pictures/plain_png.h"
#include "experiment/pictures/radiance_picture.h"

namespace overt {

namespace {

/// Why a picture with this header is not read; empty if nothing is wrong.
std::string fault_of(const PictureHeader& header) {
    const glm::ivec2 size = header.size_px;
    if (size.x < 1 || size.y < 1 || header.channels.empty())
        return "has no pixels";
    if (header.is_deep_or_volume)
        return "is a deep picture or a volume: a flat one is wanted";
    if (std::max(size.x, size.y) > most_picture_side_px)
        return fmt::format("claims {} x {} px: more than {} px a side are not read", size.x, size.y,
                           most_picture_side_px);
    // A tile is read whole, whatever of it lies in the picture.
    const glm::vec<2, std::uint64_t> covered(glm::max(glm::max(size, header.stored_px), header.tile_px));
    const std::uint64_t most_values = most_picture_bytes / sizeof(float);
    if (covered.x > most_values / covered.y || covered.x * covered.y > most_values / header.channels.size())
        return fmt::format(
            "claims {} x {} px of {} channels{}: more than {} MiB of values are not read",
            glm::max(size, header.stored_px).x, glm::max(size, header.stored_px).y, header.channels.size(),
            header.tile_px.x > 0 ? fmt::format(" in tiles of {} x {}", header.tile_px.x, header.tile_px.y)
                                 : std::string(),
            most_picture_bytes >> 20);
    return {};
}

} // namespace

PictureFile::PictureFile(std::filesystem::path file, std::string_view kind, StraightColours straight)
    : file_(std::move(file)), kind_(kind) {
    std::string fault;
    decoder_ = open_plain_exr(file_.string());
    if (!decoder_)
        decoder_ = open_radiance(file_.string(), fault);
    if (!decoder_ && fault.empty())
        decoder_ = picture_library().open(file_.string(), straight == StraightColours::as_they_stand, fault);
    if (!decoder_)
        throw InputError(fmt::format("{}: cannot be read as a {}: {}", file_.string(), kind_, fault));
    if (fault = fault_of(header()); !fault.empty())
        throw InputError(fmt::format("{}: the {} {}", file_.string(), kind_, fault));
}

PictureFile::PictureFile(std::string_view bytes, const std::string& format, std::string name,
                         std::string_view kind, StraightColours straight)
    : file_(std::move(name)), kind_(kind) {
    std::string fault;
    decoder_ = picture_library().open_bytes(bytes, format, straight == StraightColours::as_they_stand, fault);
    if (!decoder_)
        throw InputError(fmt::format("{}: cannot be read as a {}: {}", file_.string(), kind_, fault));
    if (fault = fault_of(header()); !fault.empty())
        throw InputError(fmt::format("{}: the {} {}", file_.string(), kind_, fault));
}

PictureFile::~PictureFile() = default;

const PictureHeader& PictureFile::header() const { return decoder_->header(); }

void PictureFile::read_rows(int begin, int end, int channels, PixelType as, void* into) {
    if (const std::string fault = decoder_->read(begin, end, channels, as, into); !fault.empty())
        throw InputError(fmt::format("{}: reading the {} failed: {}", file_.string(), kind_, fault));
}

void write_picture(const std::filesystem::path& file, const PictureHeader& header, PixelType type,
                   const void* pixels) {
    std::optional<std::vector<unsigned char>> bytes;
    if (file.extension() == ".exr")
        bytes = encode_plain_exr(header, type, pixels);
    else if (file.extension() == ".png")
        bytes = encode_srgb_png(header, type, pixels);
    if (!bytes) {
        const std::string fault =
            picture_library().encode(file.string(), header, type, pixels, bytes.emplace());
        if (!fault.empty())
            throw RecordError(fmt::format("{}: cannot be written: {}", file.string(), fault));
    }
    write_whole_file(file, std::as_bytes(std::span(*bytes)));
}

} // namespace overt
