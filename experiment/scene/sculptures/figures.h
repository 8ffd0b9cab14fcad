/// The three figures, each in a file of its own.
#pragma once

#include "experiment/scene/sculptures/figure.h"

namespace overt {

/// A standing woman in a long robe and a cloak.
Figure model_muse();
/// A young man who bends to the sandal on his raised foot.
Figure model_runner();
/// A standing bearded man in a cloak.
Figure model_scholar();

} // namespace overt
