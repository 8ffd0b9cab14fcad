/// A light with the statistics of natural illumination, in which gloss is judged best.
#pragma once

#include "render/image/light_probe.h"

namespace overt {

/// Changes whenever the gallery does: part of the key under which frames are kept.
constexpr int gallery_probe_version = 1;

/// Of the gallery over all directions.
constexpr double gallery_mean_luminance = 0.4;

/// A hall of a museum in the late afternoon, drawn by its geometry: tall windows to the left and one behind
/// the camera with a bluish sky and a low sun, warm lamps on the ceiling and one that stands, patches of sun,
/// a wainscot, pictures, a dark door, boards on the floor. Over all of it lies texture of equal contrast in
/// each octave. What is compact and bright makes most of the light, as outdoors and in rooms (Dror, Willsky
/// and Adelson 2004, "Statistical characterization of real-world illumination", J. Vision 4(9):11); observers
/// judge gloss by such light more reliably than by even or merely random light (Fleming, Dror and Adelson
/// 2003, "Real-world illumination and the perception of surface reflectance properties", J. Vision 3(5):3).
/// Made at the first call and then kept; from any thread.
const LightProbe& gallery_probe();

} // namespace overt
