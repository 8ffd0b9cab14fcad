/// Heads: skull, face, ears, hair and beard, about the origin between the ears. The unit is the height from
/// chin to crown, so the chin is near z = -0.5 and the crown near 0.48; the face looks along -y.
#pragma once

#include "experiment/scene/sculptures/clay.h"

namespace overt {

enum class Hair { parted, curls, waves };

/// What makes one head differ from another.
struct HeadDescription {
    Hair hair = Hair::curls;
    bool beard = false;
    double jaw = 1.0;  ///< breadth of jaw and chin; 1 is an adult man
    double brow = 1.0; ///< how far the brow stands out; 1 is an adult man
};

/// The head without its neck.
Clay sculpt_head(const HeadDescription& description);

/// Adds hair in the given fashion.
void add_hair(Clay& head, Hair hair);

/// Adds a full beard with a moustache.
void add_beard(Clay& head);

} // namespace overt
