#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

std::vector<Key> slot() {
    using S = SlotSettings;
    return {
        {"id", &S::id, identifier().required(),
         "Short name, used in file names and tables. The places of a circle or a grid \"ring\" are "
         "\"ring-1\", "
         "\"ring-2\", …."},
        {"title", &S::title, left_out("the id"), "Name for figures and reports."},
        {"right_deg", &S::right_deg, range(-80, 80, "deg").left_out("as `[view]` has it"),
         "Angle from the middle of the screen to the middle of the slot, positive to the right."},
        {"up_deg", &S::up_deg, range(-80, 80, "deg").left_out("as `[view]` has it"), "The same upwards."},
        {"size_deg", &S::size_deg, range(0.1, 120, "deg").left_out("the image of `[view]`"),
         "Width and height of a square slot: the angle that something so large has in the middle of the "
         "screen."},
        {"width_deg", &S::width_deg, range(0.1, 120, "deg").left_out("see `size_deg`"),
         "Width of a slot that is not square."},
        {"height_deg", &S::height_deg, range(0.1, 120, "deg").left_out("see `size_deg`"),
         "Height of a slot that is not square."},
        {"circle", &S::circle, range(0, 64),
         "So many places on a circle about the place that is given, the first at its top, then clockwise; 0 "
         "for a single place."},
        {"radius_deg", &S::radius_deg, range(0, 60, "deg"),
         "From the middle of the circle to that of each place."},
        {"grid", &S::grid, range(1, 64).left_out("a single place"),
         "Columns and rows of places about the place that is given, numbered as a page is read: `grid = [3, "
         "2]`."},
        {"distance_deg", &S::distance_deg, range(0, 60, "deg"),
         "Between the middles of neighbours in the grid."},
    };
}

} // namespace overt::key_rows
