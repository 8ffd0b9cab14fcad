#include "experiment/maps/picture_file.h"

#include <OpenImageIO/filesystem.h>
#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"

namespace overt {

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
