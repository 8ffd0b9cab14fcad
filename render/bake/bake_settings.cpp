#include "render/bake/bake_settings.h"

#include "experiment/base/error.h"
#include "render/bake/material_model.h"

namespace overt {

BakeSettings settings_of(BakeQuality quality, MaterialKind material) {
    OVERT_EXPECTS(quality != BakeQuality::live);
    BakeSettings settings;
    settings.samples = quality == BakeQuality::preview ? 4 : quality == BakeQuality::draft ? 16 : 256;
    if (quality == BakeQuality::standard && !model_of(material).scatters)
        settings.samples = 64;
    if (quality == BakeQuality::preview)
        settings.pixel_step = 2;
    return settings;
}

} // namespace overt
