#include "experiment/protocol/key_rows.h"

namespace overt::key_rows {

Section bake() {
    using B = BakingSettings;
    return {
        .name = "bake",
        .explanation = "How stimuli are rendered that are not given as `[[frames]]`. `overt bake` does it, "
                       "and keeps each frame; see [bake.md](bake.md).",
        .keys =
            {
                {{.name = "quality",
                  .if_left_out = "\"standard\" for people, \"preview\" for a simulated observer",
                  .explanation = "What a session needs at least; if better frames of all stimuli are there, "
                                 "it takes those. \"preview\", of half the resolution, is rendered when it "
                                 "is needed; \"live\" is drawn by OpenGL, an approximation without "
                                 "interreflection and spectra."},
                 &B::quality},
                {{.name = "samples",
                  .low = 1,
                  .high = 65536,
                  .if_left_out = "what is usual for the quality and the material",
                  .explanation = "Light paths through each pixel, of frames of this quality."},
                 &B::samples},
                {{.name = "target_error_de",
                  .low = 0.01,
                  .high = 100,
                  .if_left_out = "every pixel gets all samples",
                  .explanation = "A pixel is left when its standard error is below this many units of "
                                 "colour difference (CIE 1976)."},
                 &B::target_error_de},
                {{.name = "filter", .explanation = "How light paths about a pixel's middle are weighed."},
                 &B::filter},
                {{.name = "filter_width_px",
                  .unit = "px",
                  .low = 0,
                  .high = 3,
                  .explanation = "Full width of the filter; 0 sends all light paths through the middle."},
                 &B::filter_width_px},
                {{.name = "seed",
                  .if_left_out = "0",
                  .explanation = "Of the light paths: the same seed gives the same frames."},
                 &B::seed},
                {{.name = "observer",
                  .explanation =
                      "Whose colours the display shows: the CIE 1931 standard observer, or that of "
                      "CIE 2006, for which the display's characterisation needs spectra."},
                 &B::observer},
            },
        .home = &Protocol::bake};
}

Section frames() {
    using F = FrameSequenceSettings;
    return {
        .name = "frames",
        .explanation = "A ready-made animation of one sculpture in one material, shown instead of "
                       "rendering it.",
        .keys =
            {
                {{.name = "sculpture", .is_required = true, .explanation = "Id of a `[[sculpture]]`."},
                 &F::sculpture},
                {{.name = "material", .is_required = true, .explanation = "Id of a `[[material]]`."},
                 &F::material},
                {{.name = "files",
                  .is_required = true,
                  .explanation = "Path of the pictures from the protocol's folder, with # for the digits "
                                 "of the number: \"gold/frame_####.exr\"."},
                 &F::files},
                {{.name = "first_number",
                  .low = 0,
                  .high = 1e6,
                  .explanation = "Number of the first frame's file."},
                 &F::first_number},
                {{.name = "encoding",
                  .explanation = "What the numbers in the pictures mean: linear light, or sRGB."},
                 &F::encoding},
                {{.name = "colour_space",
                  .explanation = "Whose three numbers they are: the display's own light; Rec. 709, white "
                                 "being the display's; or CIE 1931 XYZ, Y = 1 being as bright as its white. "
                                 "The last two are turned into the light of the same colour by the "
                                 "characterisation; without one, the display is taken to have the primaries "
                                 "of Rec. 709."},
                 &F::colour_space},
                {{.name = "exposure",
                  .low = 1e-6,
                  .high = 1e6,
                  .explanation = "Factor on the light of the pictures; that of `[light]` is not for them."},
                 &F::exposure},
                {{.name = "background_colour",
                  .low = 0,
                  .high = 1,
                  .if_left_out = "alpha says what is the object",
                  .explanation =
                      "Of files without alpha: the colour that is background, as the files have "
                      "it, from 0 to 1. `overt check` compares what is left with the hidden maps."},
                 &F::background_colour},
                {{.name = "background_tolerance",
                  .low = 0,
                  .high = 1,
                  .explanation = "How far from it, in any channel, still is background."},
                 &F::background_tolerance},
            },
        .home = &Protocol::frames};
}

} // namespace overt::key_rows
