/// What looks at patches: an instrument, a person who reads one, or a simulation.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <glm/vec3.hpp>

#include "devices/light/colorcal.h"
#include "devices/simulated/simulated_display.h"

namespace overt {

/// A patch that is on the display.
struct ShownPatch {
    int number = 1; ///< from 1
    int count = 1;
    glm::dvec3 signal{0.0}; ///< 0 … 1, as the display received it
};

class PatchPhotometer {
  public:
    virtual ~PatchPhotometer() = default;
    /// In words, for the characterisation.
    virtual std::string description() const = 0;
    /// CIE 1931 XYZ in cd/m2, or nothing if somebody wants to end. Throws DeviceError.
    virtual std::optional<glm::dvec3> measure(const ShownPatch& patch) = 0;
};

/// The ColorCAL on `port`, or the only one there is. `clock` must outlive it. Throws DeviceError.
std::unique_ptr<PatchPhotometer> make_colorcal_photometer(const std::optional<std::string>& port,
                                                          Clock& clock);

/// Asks at the terminal for what an instrument shows: three numbers, X Y Z, or x y Y behind a word "xyY".
std::unique_ptr<PatchPhotometer> make_typed_photometer(std::string instrument);

std::unique_ptr<PatchPhotometer> make_simulated_photometer(const DisplayTruth& truth, std::uint64_t seed);

/// What somebody typed as XYZ; nothing if it is no such thing. Numbers stand between blanks or commas; after
/// the word xyY they are a chromaticity and a luminance.
std::optional<glm::dvec3> typed_xyz(const std::string& line);

} // namespace overt
