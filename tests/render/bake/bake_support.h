/// Small scenes for the path tracer's tests.
#pragma once

#include <fstream>

#include "experiment/scene/viewing.h"
#include "render/bake/frame_baker.h"
#include "render/bake/light_colour.h"
#include "tests/support/figures.h"
#include "tests/support/temporary_folder.h"

namespace overt::test {

/// The same light from everywhere, linear Rec.709.
inline LightProbe even_light(glm::vec3 colour = glm::vec3(1.0f)) {
    LightProbe probe{LinearImage({8, 4}), 0};
    for (glm::vec4& pixel : probe.radiance.pixels)
        pixel = glm::vec4(colour, 1.0f);
    return probe;
}

/// A camera from the front that holds the whole mesh.
inline SceneView front_view(const Mesh& mesh, int size_px) {
    SceneView scene;
    scene.bounds = mesh.bounds();
    scene.view.image_px = {size_px, size_px};
    scene.view.camera = fit_camera(mesh, {12.0}, scene.view.image_px, {25.0}, 0.06);
    return scene;
}

/// A metal that reflects all light: n = 0, k = 1.
class WhiteMetal {
  public:
    WhiteMetal() {
        std::ofstream table(file());
        table << "wavelength_nm,n,k\n300,0,1\n800,0,1\n";
    }
    std::string file() const { return (folder_.path() / "white.csv").string(); }

  private:
    TemporaryFolder folder_;
};

inline MaterialSettings material_of(MaterialKind kind, const std::string& metal = "Au") {
    MaterialSettings material;
    material.kind = kind;
    material.metal = metal;
    return material;
}

inline SpectralFrame baked(const BakeScene& scene, const SpectralLight& light, const SceneView& view,
                           const BakeSettings& settings, const ObjectPose& angle = {}) {
    return bake_frame(scene, light, view, angle, covered_pixels(scene, view, angle), settings);
}

} // namespace overt::test
