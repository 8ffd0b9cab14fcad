#include "render/bake/bake_settings.h"

#include "experiment/base/error.h"
#include "render/bake/material_model.h"

namespace overt {

BakeSettings settings_of(BakeQuality quality, MaterialKind material) {
    BakeSettings settings;
    switch (quality) {
    case BakeQuality::live:
        OVERT_EXPECTS(quality != BakeQuality::live);
        break;
    case BakeQuality::preview:
        settings.samples = 4;
        settings.pixel_step = 2;
        break;
    case BakeQuality::draft:
        settings.samples = 16;
        break;
    case BakeQuality::standard:
        settings.samples = model_of(material).scatters ? 256 : 64;
        break;
    case BakeQuality::reference:
        settings.samples = 256;
        break;
    }
    return settings;
}

} // namespace overt
