#include <fmt/format.h>

#include "experiment/checks/protocol_checks.h"
#include "experiment/stimulus/gaze_tags.h"

namespace overt {

namespace {

void check_written(ProtocolExamination& examination) {
    const StereoSettings& stereo = examination.protocol.stereo;
    for (const std::string_view key : {"interocular_mm", "largest_disparity_arcmin"})
        if (const std::string path = fmt::format("stereo.{}", key);
            !stereo.is_on() && examination.is_written(path))
            examination.warning({path, "stereo.kind"},
                                fmt::format("{} has no meaning: both eyes see the same", key),
                                "write kind = \"mirrors\" or \"frame-sequential\"");
    const bool has_mirrors = stereo.kind == StereoKind::mirrors;
    for (const std::string_view key : {"swapped", "mirrored", "left_eye_right_px", "left_eye_down_px",
                                       "right_eye_right_px", "right_eye_down_px"}) {
        const std::string path = fmt::format("stereo.{}", key);
        if (!has_mirrors && examination.is_written(path))
            examination.warning({path, "stereo.kind"},
                                fmt::format("{} has no meaning: it is for kind = \"mirrors\"", key));
    }
}

void check_halves(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const StereoSettings& stereo = protocol.stereo;
    if (stereo.kind != StereoKind::mirrors)
        return;
    const OutputMode output = protocol.display.output;
    const int step = joins_pixels_in_pairs(output) ? 4 : 2;
    if (protocol.display.width_px % step != 0)
        examination.error(
            {"display.width_px", "stereo.kind"},
            fmt::format("each eye has half of the screen: the width has to be a multiple of {}", step));
    if (stereo.mirrored && joins_pixels_in_pairs(output))
        examination.error({"stereo.mirrored", "display.output"},
                          fmt::format("{} joins pixels in pairs, which cannot be exchanged left for right",
                                      name_of(output)),
                          "take an output that does not, or a stereoscope with two mirrors to an eye");
    const glm::ivec2 field_px = field_of(protocol, Eye::left).size_px;
    for (const auto& [eye, right_key, down_key] :
         {std::tuple(Eye::left, "stereo.left_eye_right_px", "stereo.left_eye_down_px"),
          std::tuple(Eye::right, "stereo.right_eye_right_px", "stereo.right_eye_down_px")}) {
        const glm::ivec2 shift = stereo.shift_px(eye);
        if (joins_pixels_in_pairs(output) && shift.x % 2 != 0)
            examination.error({right_key, "display.output"},
                              fmt::format("{} joins pixels in pairs: write an even number", name_of(output)));
        if (std::abs(shift.x) >= field_px.x)
            examination.error({right_key}, fmt::format("an eye's half is {} px wide: nothing of its picture "
                                                       "would be left",
                                                       field_px.x));
        if (std::abs(shift.y) >= field_px.y)
            examination.error({down_key},
                              fmt::format("the screen is {} px high: nothing of the picture would "
                                          "be left",
                                          field_px.y));
        // Cut off is what lies beyond the edge of the half.
        for (const Slot& slot : protocol.slots) {
            const ScreenGeometry at = slot_geometry(protocol, slot);
            const glm::ivec2 first = at.image_origin_px + shift, end = first + at.image_px;
            const int top = reserved_rows(output);
            if (std::abs(shift.x) < field_px.x && std::abs(shift.y) < field_px.y &&
                (first.x < 0 || first.y < top || end.x > field_px.x || end.y > field_px.y))
                examination.warning({right_key, down_key},
                                    fmt::format("so far moved, a part of the stimulus in slot \"{}\" lies "
                                                "beyond the half of the {} eye, and is cut off",
                                                slot.id, eye == Eye::left ? "left" : "right"));
        }
    }
}

void check_what_has_one_eye(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    for (std::size_t i = 0; i < protocol.frames.size(); ++i)
        if (protocol.frames[i].picture_of < 0)
            examination.error({fmt::format("frames[{}].files", i), "stereo.kind"},
                              "ready-made frames are drawn for one eye, and [stereo] needs those of two",
                              "give the object's mesh, and overt renders both");
    for (std::size_t i = 0; i < protocol.objects.size(); ++i)
        if (!protocol.objects[i].lut.empty())
            examination.error({fmt::format("object[{}].lut", i), "stereo.kind"},
                              "ready-made maps are of what one eye sees, and [stereo] needs those of two",
                              "give the object's mesh");
    if (protocol.display.tags_px > 0)
        examination.error({"display.tags_px", "stereo.kind"},
                          "tags would be seen once in each eye's field, and tell a scene camera two screens");
    if (protocol.tracker.kind == tracker_kind_called("opengaze"))
        examination.error({"tracker.kind", "stereo.kind"},
                          "an Open Gaze tracker shows targets of its own, across both eyes' fields");
}

} // namespace

void check_stereo(ProtocolExamination& examination) {
    check_written(examination);
    const Protocol& protocol = examination.protocol;
    for (std::size_t i = 0; i < protocol.views.size() && !protocol.stereo.is_on(); ++i)
        if (const std::string path = fmt::format("view[{}].two_eyes", i); examination.is_written(path))
            examination.warning({path}, "two_eyes has no meaning: without [stereo] both eyes see the same");
    if (!protocol.stereo.is_on())
        return;
    check_halves(examination);
    check_what_has_one_eye(examination);
}

} // namespace overt
