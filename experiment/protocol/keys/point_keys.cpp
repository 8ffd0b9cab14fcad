#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

std::vector<Key> points() {
    using P = PointListSettings;
    return {
        {"id", &P::id, identifier().required(), "Short name; its places are called ID.1, ID.2, …."},
        {"object", &P::object, identifier().left_out("each object has a list, made alike"),
         "The object on whose surface they are."},
        {"evenly", &P::evenly, range(1, 5000).left_out("they are given one by one"),
         "So many places, spread over the surface so that equal areas have equally many and none lie close "
         "together."},
        {"area", &P::area, left_out("the whole surface"), "Of `evenly`: the named area on which they are."},
        {"facing_deg", &P::facing_deg, range(0, 90, "deg").left_out("also where nobody sees them"),
         "Of `evenly`: only where the surface is seen in `frame`, and its normal is no farther from the line "
         "of "
         "sight. Above 80 deg a pixel may be many millimetres."},
        {"frame", &P::frame, range(0, 10000),
         "Of `facing_deg`: a frame of the first motion, in the first view; from 0."},
        {"seed", &P::seed, range(0, 2147483647), "Of `evenly`: another number, other places."},
        {"vertices", &P::vertices, range(0, 2147483647).left_out("none"),
         "Vertices of the mesh, from 0, as the record has the mesh."},
        {"places", &P::places, left_out("none"),
         "A triangle of the mesh each, from 0, and the weights of its first and second corner: "
         "`[[812, 0.2, 0.3]]`. The third has the rest."},
        {"near_mm", &P::near_mm, left_out("none"),
         "Coordinates on the unturned object, in millimetres, or the mesh's own unit: each stands for the "
         "nearest place of the surface."},
    };
}

std::vector<Key> probe() {
    using P = ProbeSettings;
    return {
        {"id", &P::id, identifier().required(),
         "Short name, and that of the factor and of the column whose levels are the places."},
        {"points", &P::points, identifier().required(), "Id of the `[[points]]`."},
        {"slot", &P::slot, identifier().left_out("the task's only one"),
         "In which slot the object stands whose place it is."},
        {"mark", &P::mark, "A filled dot, a ring, or nothing, where a gauge is enough."},
        {"size_deg", &P::size_deg, range(0.01, 20, "deg"),
         "Diameter of the dot, or of the ring to the middle of its line, on the screen."},
        {"line_deg", &P::line_deg, range(0.01, 5, "deg"), "Width of the ring's line."},
        {"light", &P::light, range(0, 1), "Red, green and blue light of it, of the display's white."},
        {"rim_deg", &P::rim_deg, range(0, 5, "deg"),
         "Width of a dark rim around it, by which it is seen on a bright ground; 0: none."},
    };
}

} // namespace overt::key_rows
