/// How an ASC file writes what its single lines do not explain: found by reading all of it before.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "experiment/gaze.h"

namespace overt {

class AscFiles;

struct AscConventions {
    /// What edf2asc -miss put in place of lost values, beside a point and NaN; nothing if it is neither known
    /// nor needed.
    std::optional<double> missing_number;
    std::string missing_word; ///< the same, where it is no number

    /// Samples with a smaller pupil are lost, as edf2asc has it of EyeLinks; 0 where pupils are in another
    /// unit or were not recorded, so that they tell nothing.
    double least_pupil = 15.0;

    bool stamps_are_rounded = false; ///< to single precision: see AscStamps
    double rate_hz = 0.0;            ///< by the steps of the stamps; 0: not known
};

/// Reads the files. `missing` is what their missing values are said to be. Throws InputError if they cannot
/// be read.
AscConventions
find_conventions(const AscFiles& files, const std::optional<std::string>& missing,
                 const std::function<void(std::int64_t done, std::int64_t all)>& progress = {});

/// Beyond this a coordinate is the tracker's sign for "missing" (-32768, 1e8) or nonsense.
inline constexpr double largest_coordinate_px = 32000.0;

/// A place, nothing where it is missing, or an error.
struct AscPoint {
    bool is_valid = false;
    std::optional<ScreenPoint> point;
};

/// Of the words of its two coordinates. A word that stands for both and is no number says that there is none.
AscPoint place_of(std::string_view x, std::string_view y, const AscConventions& conventions);

/// What a sample says of one eye, or an error.
struct AscEyeValues {
    bool is_valid = false;
    std::optional<ScreenPoint> gaze; ///< nothing: lost
    float pupil = 0.0f;              ///< 0 where the gaze is lost
    /// It is the pupil's and the corneal reflection's place in the camera's picture: an EyeLink tells them,
    /// as its setting file_sample_raw_pcr has it, with a pupil of less than 0.
    bool is_raw = false;
};

AscEyeValues eye_values(std::string_view x, std::string_view y, std::string_view pupil,
                        const AscConventions& conventions);

} // namespace overt
