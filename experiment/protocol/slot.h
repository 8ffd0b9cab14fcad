/// Places on the screen at which stimuli are shown, several at once if need be.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/screen_geometry.h"

namespace overt {

struct Protocol;

/// [[slot]], as it is written: one place, or several on a circle or a grid. Angles are from the middle of the
/// screen, sizes those of something there. What is left out is as [view] has it.
struct SlotSettings {
    std::string id;
    std::string title;
    std::optional<double> right_deg, up_deg; ///< of its middle; of the middle of a circle or a grid
    std::optional<double> size_deg;          ///< of a square
    std::optional<double> width_deg, height_deg;
    int circle = 0;            ///< so many places, the first at the top, then clockwise; 0: it is none
    double radius_deg = 0.0;   ///< of the circle
    std::vector<double> grid;  ///< columns and rows, read as a page is; empty: it is none
    double distance_deg = 0.0; ///< from middle to middle in a grid
};

/// One place. Of a circle or a grid "ring", its id is "ring-1", "ring-2", ….
struct Slot {
    std::string id;
    std::string title;
    // What is left out is as [view] has it.
    std::optional<double> right_deg, up_deg, width_deg, height_deg;
    int entry = -1; ///< of the file's [[slot]]; none of the one that a protocol without them has
    int size = 0;   ///< of its image, counted among the different ones of all slots
};

/// The places of all entries, in their order; of none, one "centre", where [view] has the stimulus.
std::vector<Slot> written_out(const std::vector<SlotSettings>& entries);

/// The screen with a slot's image on it: columns and widths of a slot with a place or size of its own are
/// even, since some outputs join pixels in pairs.
ScreenGeometry slot_geometry(const Protocol& protocol, const Slot& slot);

/// Where each slot's image stands; none without [[slot]], where the only one is the view's.
std::vector<ImageBox> slot_places(const Protocol& protocol);

/// Counts the sizes that the slots' images have, and gives the views those sizes: the first to the views of
/// the list, each further one to copies of them (Protocol::views_in_slots). Where the camera is fitted to an
/// object, and where its field of view is written, the object takes the same share of the image as before; a
/// camera whose place alone is written gets the field of view that it had.
void fit_views_to_slots(Protocol& protocol);

/// The middle of a slot's image on the screen. `slot`: index into the protocol's slots.
ScreenPoint middle_of_slot(const Protocol& protocol, int slot);

/// Those that a task's stimuli are shown in, by its `slots`, each a place or all of a circle or grid; unknown
/// ones are left out. Of a task that names none: the first. Indices into the protocol's slots.
std::vector<int> slots_of_task(const Protocol& protocol, int task);

/// The places with these ids, and all places of circles and grids with them; unknown ones are left out.
std::vector<int> slots_named(const Protocol& protocol, const std::vector<std::string>& named);

} // namespace overt
