#include "experiment/protocol/protocol_checks.h"

#include <system_error>

#include <fmt/format.h>

namespace overt {

namespace {

bool is_file(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

void check_sequence(ProtocolExamination& examination, const std::string& path,
                    const FrameSequenceSettings& sequence) {
    const int count = examination.protocol.animation.frame_count;
    int missing = 0;
    std::filesystem::path first_missing;
    for (int frame = 0; frame < count; ++frame) {
        const std::filesystem::path file = frame_file(sequence, {frame});
        if (is_file(file))
            continue;
        if (missing++ == 0)
            first_missing = file;
    }
    if (missing > 0) {
        examination.error({path, "animation.frame_count"},
                          fmt::format("{} of {} frames are missing", missing, count),
                          fmt::format("the first is {}", first_missing.string()));
    }
}

} // namespace

void check_files(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const std::string remedy = "paths count from the folder of the protocol file";
    if (protocol.light.probe != "overcast" && !is_file(protocol.light.probe))
        examination.error({"light.probe"}, fmt::format("there is no file {}", protocol.light.probe),
                          remedy + "; \"overcast\" needs none");
    for (std::size_t i = 0; i < protocol.sculptures.size(); ++i) {
        const std::filesystem::path& mesh = protocol.sculptures[i].mesh;
        if (!mesh.empty() && !is_file(mesh)) {
            examination.error({fmt::format("sculpture[{}].mesh", i)},
                              fmt::format("there is no file {}", mesh.string()), remedy);
        }
    }
    for (std::size_t i = 0; i < protocol.frames.size(); ++i) {
        const std::string path = fmt::format("frames[{}].files", i);
        if (!protocol.frames[i].files.empty() && !examination.faulty.contains(path))
            check_sequence(examination, path, protocol.frames[i]);
    }
}

} // namespace overt
