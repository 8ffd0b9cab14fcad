/// The rows of the key table, section by section. Only protocol_keys.cpp puts them together.
#pragma once

#include "experiment/protocol/protocol_keys.h"

namespace overt::key_rows {

// What the experiment runs on (rig_keys.cpp).
Section display();
Section tracker();
Section further_tracker();
Section calibration();
Section events();
Section screens();

// What is shown (stimulus_keys.cpp).
Section view();
Section light();
Section animation();
Section sculpture();
Section material();

// How it becomes pictures (frame_keys.cpp).
Section bake();
Section frames();

// What is asked, and in which order (design_keys.cpp).
Section protocol();
Section schedule();
Section task();

// The order of trials and of observers (order_keys.cpp).
Section block();
Section group();

// How a session goes besides its trials (practice_keys.cpp).
Section practice();
Section breaks();
Section repeat();

// Where simulated observers look (simulation_keys.cpp).
Section simulated_observers();
Section simulated_effect();

// What surrounds the trials (sitting_keys.cpp).
Section consent();
Section instructions();
Section observer_fields();
Section operators();
Section answers();

// What else takes part: boxes with buttons, outputs of markers (device_keys.cpp).
Section button_box();
Section marker_output();

// What is said on the screen besides, and of the dataset (word_keys.cpp).
Section words();
Section dataset();

/// The names of a table's rows, in their order.
template <const auto& table>
inline constexpr auto names_in = [] {
    std::array<std::string_view, table.size()> names;
    for (std::size_t i = 0; i < table.size(); ++i)
        names[i] = table[i].name;
    return names;
}();

} // namespace overt::key_rows
