/// What has to hold between the keys of a protocol, each of which is in order by itself.
#pragma once

#include <initializer_list>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/diagnostics.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// A protocol under examination. Findings about a key are kept back where the key itself was found wrong
/// before: its default stands in for it, and what follows from that is none of the user's doing.
class ProtocolExamination {
  public:
    /// Both outlive the examination.
    ProtocolExamination(Protocol& examined, Diagnostics& found)
        : protocol(examined), diagnostics_(found), file_(examined.file.string()) {}

    Protocol& protocol;
    std::set<std::string, std::less<>> faulty; ///< paths of keys that were found wrong

    /// Reports at the first of these keys that is written. Does nothing if one of them is faulty.
    void error(std::initializer_list<std::string_view> paths, std::string message, std::string hint = {});
    void error(const std::vector<std::string>& paths, std::string message, std::string hint = {});
    void warning(std::initializer_list<std::string_view> paths, std::string message, std::string hint = {});

    /// «line 12», or «line 12 of rig.toml» for a key that stands in another file than the key `seen_from`.
    std::string line_of(std::string_view path, std::string_view seen_from) const;

    /// Where findings about files that the protocol names belong.
    Diagnostics& diagnostics() { return diagnostics_; }

    bool is_written(std::string_view path) const { return protocol.places.is_written(path); }

  private:
    bool is_any_faulty(std::initializer_list<std::string_view> paths) const;

    Diagnostics& diagnostics_;
    std::string file_;
};

// The rig: screen, image, animation, texts, schedule.
void check_image_fits(ProtocolExamination& examination);
/// What the video signal can carry, and where on the screen.
void check_output(ProtocolExamination& examination);
void check_animation(ProtocolExamination& examination);
void check_screens(ProtocolExamination& examination);
void check_schedule(ProtocolExamination& examination);
/// Limits that are written in [schedule] and do not hold in a block, because of its order.
void check_dropped_limits(ProtocolExamination& examination);

/// Blocks and groups: what they name, and what belongs together in one.
void check_blocks(ProtocolExamination& examination);
void check_groups(ProtocolExamination& examination);
void check_practice(ProtocolExamination& examination);
void check_breaks(ProtocolExamination& examination);
/// Consent, form, the operator's keys and spoken answers.
void check_sitting(ProtocolExamination& examination);

/// Reads the characterisation of the display, if the protocol names one and `look_at_files`, and finds what
/// in the protocol contradicts it or asks for it. Turns luminances into linear light.
void take_characterisation(ProtocolExamination& examination, bool look_at_files);

// The lists: ids, references, and what belongs together in one entry.
void check_ids(ProtocolExamination& examination);
void check_sculptures(ProtocolExamination& examination, std::span<const std::string_view> shipped_sculptures);
void check_materials(ProtocolExamination& examination);
void check_frames(ProtocolExamination& examination);
/// After take_characterisation().
void check_bake(ProtocolExamination& examination);

/// Whether meshes, probe and frames are there. Looks at the file system.
void check_files(ProtocolExamination& examination);

} // namespace overt
