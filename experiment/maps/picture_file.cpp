#include "experiment/maps/picture_file.h"

#include <algorithm>

#include <OpenImageIO/filesystem.h>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"

namespace overt {

namespace {

/// Why a picture with this header is not read; empty if nothing is wrong.
std::string fault_of(const OIIO::ImageSpec& spec) {
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
        return "has no pixels";
    if (spec.deep || spec.depth > 1)
        return "is a deep picture or a volume: a flat one is wanted";
    if (spec.width > most_picture_side_px || spec.height > most_picture_side_px)
        return fmt::format("claims {} x {} px: more than {} px a side are not read", spec.width, spec.height,
                           most_picture_side_px);
    // A tile is read whole, whatever of it lies in the picture.
    const std::uint64_t columns = static_cast<std::uint64_t>(std::max(spec.width, spec.tile_width));
    const std::uint64_t rows = static_cast<std::uint64_t>(std::max(spec.height, spec.tile_height));
    const std::uint64_t most_values = most_picture_bytes / sizeof(float);
    if (columns > most_values / rows ||
        columns * rows > most_values / static_cast<std::uint64_t>(spec.nchannels))
        return fmt::format("claims {} x {} px of {} channels{}: more than {} MiB of values are not read",
                           spec.width, spec.height, spec.nchannels,
                           spec.tile_width > 0
                               ? fmt::format(" in tiles of {} x {}", spec.tile_width, spec.tile_height)
                               : std::string(),
                           most_picture_bytes >> 20);
    return {};
}

} // namespace

std::unique_ptr<OIIO::ImageInput> open_picture(const std::filesystem::path& file, std::string_view kind,
                                               const OIIO::ImageSpec* wish) {
    auto input = OIIO::ImageInput::open(file.string(), wish);
    if (!input)
        throw InputError(
            fmt::format("{}: cannot be read as a {}: {}", file.string(), kind, OIIO::geterror()));
    if (const std::string fault = fault_of(input->spec()); !fault.empty())
        throw InputError(fmt::format("{}: the {} {}", file.string(), kind, fault));
    return input;
}

void write_picture(const std::filesystem::path& file, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                   const void* pixels) {
    // Into memory first: when a disk fills up, libraries of picture formats do not always say so.
    OIIO::Filesystem::IOVecOutput memory;
    auto output = OIIO::ImageOutput::create(file.string());
    const bool written = output && output->set_ioproxy(&memory) && output->open(file.string(), spec) &&
                         output->write_image(type, pixels) && output->close();
    if (!written) {
        throw RecordError(fmt::format("{}: cannot be written: {}", file.string(),
                                      output ? output->geterror() : OIIO::geterror()));
    }
    write_whole_file(file, std::as_bytes(std::span(memory.buffer())));
}

} // namespace overt
