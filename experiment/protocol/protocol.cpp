#include "experiment/protocol/protocol.h"

#include <algorithm>

#include <fmt/format.h>

namespace overt {

std::filesystem::path frame_file(const FrameSequenceSettings& sequence, AnimationFrameIndex frame) {
    const std::size_t begin = sequence.files.find('#');
    if (begin == std::string::npos)
        return sequence.files;
    const std::size_t end = std::min(sequence.files.find_first_not_of('#', begin), sequence.files.size());
    return fmt::format("{}{:0{}}{}", sequence.files.substr(0, begin), sequence.first_number + frame.value,
                       end - begin, sequence.files.substr(end));
}

const FrameSequenceSettings* find_frames(const Protocol& protocol, int sculpture, int material) {
    const std::string& sculpture_id = protocol.sculptures.at(static_cast<std::size_t>(sculpture)).id;
    const std::string& material_id = protocol.materials.at(static_cast<std::size_t>(material)).id;
    const auto found = std::find_if(
        protocol.frames.begin(), protocol.frames.end(), [&](const FrameSequenceSettings& sequence) {
            return sequence.sculpture == sculpture_id && sequence.material == material_id;
        });
    return found == protocol.frames.end() ? nullptr : &*found;
}

} // namespace overt
