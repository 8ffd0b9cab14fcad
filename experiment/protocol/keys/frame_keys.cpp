#include "experiment/protocol/keys/key_rows.h"

namespace overt::key_rows {

std::vector<Key> bake() {
    using B = BakingSettings;
    return {
        {"quality", &B::quality, left_out("\"standard\" for people, \"preview\" for a simulated observer"),
         "What a session needs at least; if better frames of all stimuli are there, it takes those. "
         "\"preview\", of half the resolution, is rendered when it is needed; \"live\" is drawn by OpenGL, "
         "an approximation without interreflection and spectra."},
        {"samples", &B::samples, range(1, 65536).left_out("what is usual for the quality and the material"),
         "Light paths through each pixel, of frames of this quality."},
        {"target_error_de", &B::target_error_de, range(0.01, 100).left_out("every pixel gets all samples"),
         "A pixel is left when its standard error is below this many units of colour difference (CIE 1976)."},
        {"filter", &B::filter, "How light paths about a pixel's middle are weighed."},
        {"filter_width_px", &B::filter_width_px, range(0, 3, "px"),
         "Full width of the filter; 0 sends all light paths through the middle."},
        {"seed", &B::seed, left_out("0"), "Of the light paths: the same seed gives the same frames."},
        {"observer", &B::observer,
         "Whose colours the display shows: the CIE 1931 standard observer, or that of CIE 2006, for which "
         "the display's characterisation needs spectra."},
    };
}

std::vector<Key> frames() {
    using F = FrameSequenceSettings;
    return {
        {"object", &F::object, required(), "Id of a `[[object]]`."},
        {"material", &F::material, required(), "Id of a `[[material]]`."},
        {"light", &F::light, left_out("the only one"), "Id of a `[[light]]`, where there are several."},
        {"motion", &F::motion, left_out("the only one"), "Id of a `[[motion]]`, likewise."},
        {"view", &F::view, left_out("the only one"), "Id of a `[[view]]`, likewise."},
        {"files", &F::files, required(),
         "Path of the pictures from the protocol's folder, with # for the digits of the number: "
         "\"gold/frame_####.exr\"."},
        {"first_number", &F::first_number, range(0, 1e6), "Number of the first frame's file."},
        {"encoding", &F::encoding, "What the numbers in the pictures mean: linear light, or sRGB."},
        {"colour_space", &F::colour_space,
         "Whose three numbers they are: the display's own light; Rec. 709, white being the display's; or CIE "
         "1931 XYZ, Y = 1 being as bright as its white. The last two are turned into the light of the same "
         "colour by the characterisation; without one, the display is taken to have the primaries of Rec. "
         "709."},
        {"exposure", &F::exposure, range(1e-6, 1e6),
         "Factor on the light of the pictures; that of `[light]` is not for them."},
        {"background_colour", &F::background_colour, range(0, 1).left_out("alpha says what is the object"),
         "Of files without alpha: the colour that is background, as the files have it, from 0 to 1. `overt "
         "check` compares what is left with the hidden maps."},
        {"background_tolerance", &F::background_tolerance, range(0, 1),
         "How far from it, in any channel, still is background."},
    };
}

} // namespace overt::key_rows
