#include "experiment/checks/protocol_checks.h"
#include "experiment/spectra/metal_table.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

namespace overt {

namespace {

bool is_file(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
}

/// Whether all files of an animation are there; `file_of(frame)` names them, `what` is what they hold.
template <class FileOf>
void check_sequence(ProtocolExamination& examination, const std::string& path, std::size_t motion,
                    const char* what, const FileOf& file_of) {
    const int count = examination.protocol.motions[motion].frame_count;
    int missing = 0;
    std::filesystem::path first_missing;
    for (int frame = 0; frame < count; ++frame) {
        const std::filesystem::path file = file_of(AnimationFrameIndex{frame});
        if (is_file(file))
            continue;
        if (missing++ == 0)
            first_missing = file;
    }
    if (missing > 0) {
        examination.error({path, fmt::format("motion[{}].frame_count", motion)},
                          fmt::format("{} of {} {} are missing", missing, count, what),
                          fmt::format("the first is {}", first_missing.string()));
    }
}

} // namespace

void check_files(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const std::string remedy = "paths count from the folder of the protocol file";
    for (std::size_t i = 0; i < protocol.lights.size(); ++i) {
        const LightSettings& light = protocol.lights[i];
        if (light.is_file() && !is_file(light.probe))
            examination.error({fmt::format("light[{}].probe", i)},
                              fmt::format("there is no file {}", light.probe),
                              remedy + "; \"gallery\", \"overcast\" and \"dark\" need none");
    }
    for (std::size_t i = 0; i < protocol.backgrounds.size(); ++i) {
        const std::string& picture = protocol.backgrounds[i].picture;
        if (!picture.empty() && !is_file(picture))
            examination.error({fmt::format("background[{}].picture", i)},
                              fmt::format("there is no file {}", picture), remedy);
    }
    for (std::size_t i = 0; i < protocol.objects.size(); ++i) {
        const ObjectSettings& object = protocol.objects[i];
        for (const auto& [key, file] :
             {std::pair{"mesh", &object.mesh}, std::pair{"labels", &object.labels}}) {
            if (!file->empty() && !is_file(*file))
                examination.error({fmt::format("object[{}].{}", i, key)},
                                  fmt::format("there is no file {}", file->string()), remedy);
        }
        const std::string lut = fmt::format("object[{}].lut", i);
        if (!protocol.objects[i].lut.empty() && !examination.faulty.contains(lut)) {
            check_sequence(examination, lut, 0, "maps",
                           [&](AnimationFrameIndex frame) { return lut_file(protocol.objects[i], frame); });
        }
    }
    for (std::size_t i = 0; i < protocol.materials.size(); ++i) {
        const std::string& metal = protocol.materials[i].metal;
        if (is_metal_file(metal) && !is_file(metal)) {
            examination.error({fmt::format("material[{}].metal", i)},
                              fmt::format("there is no file {}", metal), remedy);
        }
    }
    for (std::size_t i = 0; i < protocol.frames.size(); ++i) {
        const std::string path = place_of_frames(protocol, i);
        // An unknown motion has been found already.
        const auto motion =
            std::ranges::find(protocol.motions, protocol.frames[i].motion, &MotionSettings::id);
        if (!protocol.frames[i].files.empty() && !examination.faulty.contains(path))
            check_sequence(examination, path,
                           motion == protocol.motions.end()
                               ? 0
                               : static_cast<std::size_t>(motion - protocol.motions.begin()),
                           "frames",
                           [&](AnimationFrameIndex frame) { return frame_file(protocol.frames[i], frame); });
    }
}

} // namespace overt
