/// Objects that are flat pictures.
#pragma once

#include "experiment/protocol/protocol.h"

namespace overt {

/// Makes of each object with a picture what the rest of the program knows: a size on the screen, areas in its
/// millimetres (x to the right and z upwards from the lower left corner, y = 0), and ready-made frames in
/// every material, light, motion and view. The sizes of views must be known. A protocol that has nothing but
/// pictures needs no material: it gets one, called "picture". Resolves nothing: paths of pictures are whole.
void complete_pictures(Protocol& protocol);

/// Before that: the material of a protocol that has nothing but pictures and names none.
void add_material_of_pictures(Protocol& protocol);

} // namespace overt
