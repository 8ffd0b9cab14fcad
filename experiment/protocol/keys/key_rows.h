/// The rows of the key table, section by section. Only protocol_keys.cpp puts them together.
#pragma once

#include <fmt/format.h>

#include "experiment/base/kind_table.h"
#include "experiment/protocol/keys/protocol_keys.h"

namespace overt::key_rows {

// What the experiment runs on (rig_keys.cpp).
std::vector<Key> display(), stereo(), tracker(), further_tracker(), calibration(), events(), screens();
// What is shown (stimulus_keys.cpp).
std::vector<Key> view(), light(), lamp(), background(), motion(), object(), area(), material();
// Where on the screen (slot_keys.cpp).
std::vector<Key> slot();
// How it becomes pictures (frame_keys.cpp).
std::vector<Key> bake(), frames();
// What is asked, and in which order (design_keys.cpp).
std::vector<Key> protocol(), schedule(), task();
// How it is answered (answer_keys.cpp).
std::vector<Key> answer(), answer_truth();
// Places on surfaces, and marks there (point_keys.cpp).
std::vector<Key> points(), probe();
// Where trials come from (trials_keys.cpp).
std::vector<Key> trials(), catch_trials(), draw();
// What chooses their levels (procedure_keys.cpp).
std::vector<Key> procedure();
// The order of trials and of observers (order_keys.cpp).
std::vector<Key> block(), criterion(), group();
// How a session goes besides its trials (practice_keys.cpp).
std::vector<Key> practice(), breaks(), repeat();
// Where simulated observers look (simulation_keys.cpp).
std::vector<Key> simulated_observers(), simulated_effect();
// What surrounds the trials (sitting_keys.cpp).
std::vector<Key> consent(), instructions(), observer_fields(), operators(), answers();
// What else takes part: boxes with buttons, outputs of markers (device_keys.cpp).
std::vector<Key> button_box(), marker_output();
// What is said on the screen besides, and of the dataset (word_keys.cpp).
std::vector<Key> words(), dataset();

/// A key for each of the lists that stimuli are made of, which names one of its entries by its id.
template <class Struct>
void add_entry_keys(std::vector<Key>& keys, EntryOfEach Struct::*entries, std::string_view if_left_out) {
    static const auto explanations = [] {
        std::array<std::string, stimulus_lists.size()> all;
        for (std::size_t list = 0; list < all.size(); ++list)
            all[list] = fmt::format("Id of the {}.", stimulus_lists[list].name);
        return all;
    }();
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        keys.emplace_back(stimulus_lists[list].name, entries, list, identifier().left_out(if_left_out),
                          explanations[list]);
}

/// "`one`: …. `other`: ….", after `words`.
template <TableKind Kind> std::string_view explanation_of_kinds(std::string_view words = {}) {
    static const std::string text = [&] {
        std::string all(words);
        for (const auto& kind : kinds_of<Kind>)
            all += fmt::format("{}`{}`: {}.", all.empty() ? "" : " ", kind.name, kind.explanation);
        return all;
    }();
    return text;
}

/// The names of a table's rows, in their order.
template <const auto& table>
inline constexpr auto names_in = [] {
    std::array<std::string_view, table.size()> names;
    for (std::size_t i = 0; i < table.size(); ++i)
        names[i] = table[i].name;
    return names;
}();

} // namespace overt::key_rows
