#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/checks/protocol_checks.h"
#include "experiment/protocol/keys/protocol_keys.h"
#include "experiment/stimulus/frame_memory.h"
#include "experiment/stimulus/gaze_tags.h"
#include "experiment/stimulus/photodiode_patch.h"

namespace overt {

namespace {

/// A table of colours takes 8 pixels of key, 4 of nothing and 2 for each of its 256 entries; the data packet
/// is shorter.
constexpr int t_lock_row_px = 524;

void check_keys_of_mode(ProtocolExamination& examination) {
    const DisplaySettings& display = examination.protocol.display;
    const OutputModeRow& row = row_of(display.output);
    const std::string_view mode = row.name;
    if (joins_pixels_in_pairs(display.output)) {
        if (display.width_px % 2 != 0)
            examination.error({"display.width_px", "display.output"},
                              fmt::format("{} joins pixels in pairs: the width has to be even", mode));
    } else if (display.pair_filter != PairFilter::box) {
        examination.error({"display.pair_filter"},
                          fmt::format("{} joins no pixels in pairs: pair_filter has no meaning", mode));
    }
    if (!row.is_packed) {
        if (display.gamma == 1.0 && !examination.is_written("display.gamma") &&
            !examination.is_written("display.characterisation") &&
            display.linearised_by == LinearisedBy::unsaid) {
            examination.warning(
                {"display.output", "display.gamma"},
                fmt::format("{} with the default gamma of 1: the display would have to linearise itself",
                            mode),
                "ordinary monitors need gamma = 2.2, or a characterisation; write linearised_by = "
                "\"display\" if it does");
        }
    } else if (display.dither != Dithering::none) {
        examination.error(
            {"display.dither"},
            fmt::format("{} carries 16 bits in bytes that noise would turn into others: nothing to dither",
                        mode),
            "leave dither out, or take output = \"native-8bit\"");
    }
    if (has_t_lock(display.output)) {
        if (display.onset_trigger > 1023)
            examination.error(
                {"display.onset_trigger"},
                fmt::format("{} has ten digital outputs: onset_trigger may be 1023 at most", mode));
        if (field_of(examination.protocol, Eye::left).size_px.x < t_lock_row_px)
            examination.error(
                {"display.width_px", "display.output"},
                fmt::format("{} carries messages in rows of {} px: {} is narrower", mode, t_lock_row_px,
                            examination.protocol.stereo.is_on() ? "an eye's half" : "the screen"));
    } else {
        if (display.onset_trigger != 0 && row.top_rows == TopRows::none)
            examination.error({"display.onset_trigger"},
                              fmt::format("{} has no digital outputs: onset_trigger needs {}", mode,
                                          listed(names_of_modes([](const OutputModeRow& other) {
                                              return other.top_rows != TopRows::none;
                                          }))));
        if (display.box.starts_with('/'))
            examination.error({"display.box"},
                              fmt::format("{} is sent through no box: box needs {}", mode,
                                          listed(names_of_modes([](const OutputModeRow& other) {
                                              return other.top_rows == TopRows::t_lock;
                                          }))));
    }
    if (display.box != "auto" && display.box != "none" && !display.box.starts_with('/'))
        examination.error({"display.box"}, fmt::format("\"{}\" is no serial port", display.box),
                          "write \"auto\", \"none\", or a path such as \"/dev/ttyACM0\"");
}

/// Whether the words on what linearises the display agree with each other.
void check_linearisation(ProtocolExamination& examination) {
    const DisplaySettings& display = examination.protocol.display;
    const bool is_measured = examination.is_written("display.characterisation");
    const bool goes_through_box = has_t_lock(display.output) && display.box != "none";
    const bool is_linear_table = display.box_gamma_table == linear_box_table;
    switch (display.linearised_by) {
    case LinearisedBy::unsaid:
        break;
    case LinearisedBy::display:
    case LinearisedBy::box:
        if (display.gamma != 1.0)
            examination.error(
                {"display.gamma", "display.linearised_by"},
                fmt::format("light is said to be proportional to the signal already: with gamma "
                            "= {:g} it would be corrected twice",
                            display.gamma),
                "leave gamma out, or write linearised_by = \"none\"");
        break;
    case LinearisedBy::none:
        if (display.gamma == 1.0 && !is_measured)
            examination.error({"display.linearised_by", "display.gamma"},
                              "nothing is said to linearise the display, and gamma = 1 corrects for nothing",
                              "write its gamma, such as 2.2, or measure a characterisation");
        break;
    }
    if (display.linearised_by == LinearisedBy::box) {
        if (!goes_through_box)
            examination.error({"display.linearised_by", "display.output"},
                              fmt::format("{} is sent through no box whose table could linearise the display",
                                          name_of(display.output)),
                              "write linearised_by = \"display\" or \"none\"");
        else if (is_linear_table)
            examination.error(
                {"display.linearised_by", "display.box_gamma_table"},
                fmt::format("{} leaves values as they are, and linearises nothing", display.box_gamma_table),
                "name the table that was made for this display with box_gamma_table");
    } else if (!is_linear_table) {
        if (!goes_through_box)
            examination.error({"display.box_gamma_table"},
                              fmt::format("{} is sent through no box: box_gamma_table has no meaning",
                                          name_of(display.output)));
        else if (!is_measured)
            examination.error({"display.box_gamma_table", "display.linearised_by"},
                              "a table of the box changes values, where the box is not said to linearise the "
                              "display",
                              "write linearised_by = \"box\", or leave box_gamma_table out");
    }
}

void check_place(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const ViewSettings& view = protocol.views.front();
    if (view.left_px && view.centre_right_deg)
        examination.error({"view[0].centre_right_deg"}, "left_px already says where the stimulus is");
    if (view.top_px && view.centre_up_deg)
        examination.error({"view[0].centre_up_deg"}, "top_px already says where the stimulus is");
    if (!protocol.slot_entries.empty())
        return; // their places are checked themselves
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    const glm::ivec2 first = geometry.image_origin_px, last = first + geometry.image_px - 1;
    // What is larger than the screen has been found already, and is nowhere inside it.
    if (geometry.image_px.x <= geometry.screen_px.x && (first.x < 0 || last.x >= geometry.screen_px.x)) {
        examination.error({"view[0].left_px", "view[0].centre_right_deg", "view[0].width_px"},
                          fmt::format("the stimulus takes the columns {} to {}, the screen has 0 to {}",
                                      first.x, last.x, geometry.screen_px.x - 1));
    }
    if (geometry.image_px.y > geometry.screen_px.y)
        return;
    if (first.y < 0 || last.y >= geometry.screen_px.y) {
        examination.error({"view[0].top_px", "view[0].centre_up_deg", "view[0].height_px"},
                          fmt::format("the stimulus takes the rows {} to {}, the screen has 0 to {}", first.y,
                                      last.y, geometry.screen_px.y - 1));
    } else if (const int rows = reserved_rows(protocol.display.output); first.y < rows) {
        examination.error(
            {"view[0].top_px", "view[0].centre_up_deg", "view[0].height_px", "display.output"},
            fmt::format(
                "the stimulus begins in row {}, but {} keeps the first {} for messages to the display",
                first.y, name_of(protocol.display.output), rows == 1 ? "row" : "three rows"),
            fmt::format("take height_px = {}, or place the stimulus with top_px",
                        geometry.image_px.y - 2 * (rows - first.y)));
    }
}

void check_photodiode(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const std::optional<PatchPlace> patch = photodiode_patch_of(display_of_field(protocol));
    if (!patch) {
        if (examination.is_written("display.photodiode_px"))
            examination.warning({"display.photodiode_px"}, "no square is shown: photodiode says no corner");
        return;
    }
    if (!protocol.slot_entries.empty())
        return;
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    const glm::ivec2 first = patch->origin_px - patch_distance_px, end = patch->end_px() + patch_distance_px;
    const glm::ivec2 image = geometry.image_origin_px, image_end = image + geometry.image_px;
    if (first.x < image_end.x && end.x > image.x && first.y < image_end.y && end.y > image.y) {
        examination.error(
            {"display.photodiode", "display.photodiode_px"},
            fmt::format(
                "the square takes the columns {} to {} and the rows {} to {}, closer than {} px to the "
                "stimulus in columns {} to {} and rows {} to {}",
                patch->origin_px.x, patch->end_px().x - 1, patch->origin_px.y, patch->end_px().y - 1,
                patch_distance_px, image.x, image_end.x - 1, image.y, image_end.y - 1),
            "take a smaller photodiode_px or another corner, or place the stimulus with left_px and top_px");
    }
}

void check_tags(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const DisplaySettings display = display_of_field(protocol);
    if (display.tags_px == 0) {
        if (examination.is_written("display.tags_light"))
            examination.warning({"display.tags_light"}, "no tags are shown: tags_px says no size");
        return;
    }
    const int step = tag_modules * (joins_pixels_in_pairs(display.output) ? 2 : 1);
    if (display.tags_px % step != 0) {
        examination.error({"display.tags_px"},
                          fmt::format("a tag is {} modules wide, each of whole pixels{}", tag_modules,
                                      step > tag_modules ? ", and of whole pairs of them" : ""),
                          fmt::format("write a multiple of {}, such as {}", step,
                                      std::max(step, display.tags_px / step * step)));
        return;
    }
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    const std::optional<PatchPlace> patch = photodiode_patch_of(display);
    std::vector<ImageBox> images = slot_places(protocol);
    if (images.empty())
        images.push_back(geometry.image_box());
    const std::vector<TagPlace> tags = gaze_tags_of(geometry, display, images);
    for (const TagPlace& tag : tags) {
        const auto place = fmt::format("the tag in columns {} to {} and rows {} to {}", tag.origin_px.x,
                                       tag.end_px().x - 1, tag.origin_px.y, tag.end_px().y - 1);
        if (std::ranges::any_of(images, [&](const ImageBox& image) { return touches(tag, image); })) {
            examination.error({"display.tags_px"},
                              fmt::format("{} is closer than {} px to the stimulus", place, tag_distance_px),
                              "take smaller tags or a smaller stimulus");
            return;
        }
        if (patch && touches(tag, patch->origin_px, patch->size_px)) {
            examination.error(
                {"display.photodiode", "display.tags_px"},
                fmt::format("{} is closer than {} px to the square for a photodiode", place, tag_distance_px),
                "tags take all corners: measure with the photodiode in a session without them");
            return;
        }
        for (const TagPlace& other : tags)
            if (other.id < tag.id && touches(tag, other.origin_px, other.size_px)) {
                examination.error({"display.tags_px"}, "the tags meet each other", "take smaller ones");
                return;
            }
    }
}

void check_frame_store(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const double page_mb = 1e-6 * page_bytes(protocol), store_mb = protocol.display.frame_store_mb;
    for (std::size_t motion = 0; motion < protocol.motions.size(); ++motion) {
        const int pages = most_pages(protocol, static_cast<int>(motion));
        const double stimulus_mb = page_mb * pages;
        if (stimulus_mb <= store_mb || is_streamed(protocol, static_cast<int>(motion)))
            continue;
        const std::string named = protocol.motions.size() > 1
                                      ? fmt::format(" in motion \"{}\" takes, with {},",
                                                    protocol.motions[motion].id, counted(pages, "picture"))
                                      : " takes";
        const std::string frames = fmt::format("motion[{}].frame_count", motion),
                          store = "display.frame_store_mb";
        const bool is_one_of_several = protocol.motions.size() > 1;
        examination.error(
            {is_one_of_several ? frames : store, is_one_of_several ? store : frames, "view[0].width_px",
             "view[0].height_px"},
            fmt::format("a stimulus{} {:.4g} MB of the frame store, which may take {}", named, stimulus_mb,
                        store_mb),
            fmt::format("write frame_store_mb = {:.0f}, if the graphics card has as much ({:.0f} "
                        "with the next stimulus), or show fewer or smaller frames",
                        std::ceil(stimulus_mb), std::ceil(2.0 * stimulus_mb)));
    }
}

void check_timing_claim(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    if (protocol.display.timing == TimingClaim::unproven &&
        protocol.repeat.missed_refreshes != RepeatWhen::never)
        examination.warning({"repeat.missed_refreshes", "display.timing"},
                            "trials come again for missed refreshes that are counted by times that nothing "
                            "proves",
                            "leave missed_refreshes out, or prove the times: timing = \"proven\"");
}

} // namespace

void check_output(ProtocolExamination& examination) {
    check_keys_of_mode(examination);
    check_linearisation(examination);
    check_place(examination);
    check_photodiode(examination);
    check_tags(examination);
    check_frame_store(examination);
    check_timing_claim(examination);
}

} // namespace overt
