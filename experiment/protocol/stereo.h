/// Two eyes' pictures: where each eye's field is on the screen, and from where each eye looks.
#pragma once

#include <glm/glm.hpp>

#include "experiment/base/enum_names.h"
#include "experiment/gaze.h"
#include "experiment/screen_geometry.h"
#include "experiment/trial.h"

namespace overt {

struct Protocol;
struct DisplaySettings;

/// How each eye is given its own picture.
enum class StereoKind : std::uint8_t {
    none,            ///< both see the same
    mirrors,         ///< each eye has half of the screen, through a stereoscope
    frame_sequential ///< both have the whole screen in turn, through shutters that the graphics card drives
};
template <>
inline constexpr auto names_of<StereoKind> = enum_names<StereoKind>("none", "mirrors", "frame-sequential");

/// [stereo]. Everything that is shown is shown to both eyes, each with the view from its own place; places on
/// the screen, targets and gaze are those of an eye's field, which both eyes have alike.
struct StereoSettings {
    StereoKind kind = StereoKind::none;
    /// Between the middles of the pupils. Mean of adults (Dodgson 2004, Proc. SPIE 5291: 63 mm).
    double interocular_mm = 63.0;
    bool swapped = false;  ///< the right eye sees the left half
    bool mirrored = false; ///< each field is drawn with left and right exchanged, for one mirror per eye
    /// How far an eye's picture is moved to the right and down from its place in its half, by an adjustment.
    int left_eye_right_px = 0, left_eye_down_px = 0, right_eye_right_px = 0, right_eye_down_px = 0;
    /// Beyond which `check` warns: a degree, a rule of thumb for comfort (Lambooij et al. 2009, J. Imaging
    /// Sci. Technol. 53). Without vergence 27 arcmin near and 24 far were fused at 0.2 s (Yeh and Silverstein
    /// 1990, Human Factors 32).
    double largest_disparity_arcmin = 60.0;

    bool is_on() const { return kind != StereoKind::none; }
    glm::ivec2 shift_px(Eye eye) const {
        return eye == Eye::left ? glm::ivec2(left_eye_right_px, left_eye_down_px)
                                : glm::ivec2(right_eye_right_px, right_eye_down_px);
    }
};

/// The pixels of an eye's field on the whole screen, before it is moved: a half, or all of it. The same size
/// for both eyes.
ImageBox field_of(const Protocol& protocol, Eye eye);

/// The whole screen, with the first image where screen_geometry_of() has it in a field.
ScreenGeometry whole_screen_of(const Protocol& protocol);

/// [display] as if an eye's field were the screen.
DisplaySettings display_of_field(const Protocol& protocol);

/// A place that is told from the middle of the whole screen, in pixels to the right and down, from the middle
/// of the field that it lies in.
glm::dvec2 in_field(const Protocol& protocol, glm::dvec2 from_middle_px);

/// Millimetres to the right of the middle between the eyes where this eye is; 0 without [stereo].
double aside_mm(const StereoSettings& stereo, Eye eye);

/// Puts the views of the right eye behind those of the left, at all sizes that slots have: of a protocol that
/// is otherwise complete. Does nothing without [stereo].
void add_views_of_eyes(Protocol& protocol);

} // namespace overt
