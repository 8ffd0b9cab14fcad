#include "app/check/shipped_protocols.h"

#include <array>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "protocol_texts.h"

namespace overt {

namespace {

void replace_each(std::string& text, const std::string& words, const std::string& by) {
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + by.size()))
        text.replace(at, words.size(), by);
}

} // namespace

std::span<const ShippedProtocol> shipped_protocols() {
    using namespace embedded;
    static constexpr auto rooms = std::to_array<ShippedProtocol::Picture>({
        {"pictures/room_1.png", room_1_png},
        {"pictures/room_2.png", room_2_png},
        {"pictures/room_3.png", room_3_png},
        {"pictures/swing_00.png", swing_00_png},
        {"pictures/swing_01.png", swing_01_png},
        {"pictures/swing_02.png", swing_02_png},
        {"pictures/swing_03.png", swing_03_png},
        {"pictures/swing_04.png", swing_04_png},
        {"pictures/swing_05.png", swing_05_png},
        {"pictures/swing_06.png", swing_06_png},
        {"pictures/swing_07.png", swing_07_png},
        {"pictures/swing_08.png", swing_08_png},
        {"pictures/swing_09.png", swing_09_png},
        {"pictures/swing_10.png", swing_10_png},
        {"pictures/swing_11.png", swing_11_png},
    });
    static constexpr auto all = std::to_array<ShippedProtocol>({
        {"quick_look", "the smallest experiment that has everything in it", quick_look_toml},
        {"overt_2019", "the paper's: six tasks on turning sculptures in three metals", overt_2019_toml},
        {"which_is_glossier", "pairs of plastics, which is glossier, and how sure", which_is_glossier_toml},
        {"gloss_scaling", "a scale of gloss by differences, then a threshold", gloss_scaling_toml},
        {"gloss_matching", "the gloss of one figure set to that of another under other light",
         gloss_matching_toml},
        {"material_ratings", "nine qualities of materials on scales", material_ratings_toml},
        {"gauge_figure", "slant and tilt of a surface, set with a gauge", gauge_figure_toml},
        {"surface_points", "a place on an object, pointed at", surface_points_toml},
        {"shape_recognition", "shapes that are learned, then told from new ones", shape_recognition_toml},
        {"mesh_saliency", "free viewing of shapes, still and with a camera that moves", mesh_saliency_toml},
        {"active_exploration", "an object that the observer turns, or only looks at",
         active_exploration_toml},
        {"odd_one_out", "triplets of materials, which does not belong", odd_one_out_toml},
        {"material_search", "a material among others, present or not", material_search_toml},
        {"delayed_match", "the same material under another light, after a delay", delayed_match_toml},
        {"gaze_contingent", "a shape that comes and goes by where the eyes are", gaze_contingent_toml},
        {"pictures", "pictures and a movie with areas, without a shape", pictures_toml, rooms},
    });
    return all;
}

std::string begun_from(const ShippedProtocol& shipped, const std::string& name, const std::string& file) {
    std::string text(shipped.text);
    replace_each(text, fmt::format("protocols/{}.toml", shipped.name), file);
    const std::string named = fmt::format("\nname = \"{}\"\n", shipped.name);
    const std::size_t at = text.find(named);
    OVERT_EXPECTS(at != std::string::npos);
    text.replace(at, named.size(), fmt::format("\nname = \"{}\"\n", name));
    return text;
}

} // namespace overt
