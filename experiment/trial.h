/// What one observer does in one sitting: trials, each a question about one stimulus.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace overt {

/// What the observer looks at: an object in a material, under a light, in a motion, in a view. Indices into
/// the protocol's lists.
struct Stimulus {
    int object = 0;
    int material = 0;
    int light = 0;
    int motion = 0;
    int view = 0;
    friend constexpr auto operator<=>(const Stimulus&, const Stimulus&) = default;
};

/// An object in a view: what maps show, whatever its material and its light.
struct ViewedObject {
    int object = 0;
    int view = 0;
    friend constexpr auto operator<=>(const ViewedObject&, const ViewedObject&) = default;
};
constexpr ViewedObject viewed(const Stimulus& stimulus) { return {stimulus.object, stimulus.view}; }

/// One presentation under one task.
struct Trial {
    int index = 0; ///< position in the observer's order, from 0
    int task = 0;  ///< index into the protocol's tasks
    Stimulus stimulus;
    int block = 0; ///< index into the protocol's blocks; 0 if it has none
    friend constexpr bool operator==(const Trial&, const Trial&) = default;
};

/// Who sits there. `number` counts observers from 1 and decides the rotation of materials; `label` is what
/// files are named by.
struct Observer {
    std::string label;
    int number = 1;
};

/// The order of one observer's trials, and the seed from which it can be made again.
struct Schedule {
    Observer observer;
    std::uint64_t seed = 0;
    std::vector<Trial> trials;
    bool is_even = true; ///< no order that keeps to the limits was more probable than another; not recorded
};

} // namespace overt
