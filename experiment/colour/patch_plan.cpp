#include "experiment/colour/patch_plan.h"

#include "experiment/base/error.h"
#include "experiment/base/random.h"

namespace overt {

std::vector<glm::dvec3> plan_patches(const PatchPlanSettings& settings) {
    OVERT_EXPECTS(settings.levels >= 6 && settings.mixed >= 0 && settings.repeats >= 1);
    std::vector<glm::dvec3> patches{{0, 0, 0}, {1, 1, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
    for (int channel = 0; channel < 3; ++channel) {
        for (int level = 1; level < settings.levels; ++level) {
            glm::dvec3 alone(0.0);
            alone[channel] = static_cast<double>(level) / (settings.levels - 1);
            patches.push_back(alone);
        }
        // A level that is on the ramp, too, with the others lit: do they leave its light as it is?
        glm::dvec3 step(1.0);
        const int middle = settings.levels / 2;
        step[channel] = static_cast<double>(middle) / (settings.levels - 1);
        patches.push_back(step);
    }
    RandomStream random(settings.seed, "patches of a characterisation");
    for (int i = 0; i < settings.mixed; ++i) {
        // Every third a grey.
        const double grey = random.uniform(0.15, 1.0);
        if (i % 3 == 0)
            patches.emplace_back(grey);
        else {
            const double red = random.uniform(0.1, 1.0), green = random.uniform(0.1, 1.0);
            patches.emplace_back(red, green, random.uniform(0.1, 1.0));
        }
    }
    std::vector<glm::dvec3> all;
    for (int repeat = 0; repeat < settings.repeats; ++repeat) {
        random.shuffle(std::span(patches));
        all.insert(all.end(), patches.begin(), patches.end());
    }
    return all;
}

} // namespace overt
