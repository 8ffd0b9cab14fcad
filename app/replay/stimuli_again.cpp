#include "app/replay/stimuli_again.h"

#include <algorithm>

#include "app/inputs/prepared_stimuli.h"
#include "app/session/recorded_options.h"

namespace overt {

namespace fs = std::filesystem;

StimuliAgain::StimuliAgain(const Experiment& experiment, const fs::path& cache, ContextChoice context)
    : display_({.context = context, .headless = true}),
      library_(std::make_unique<StimulusLibrary>(display_.context(), experiment.protocol, experiment.objects,
                                                 cache)) {}

std::string StimuliAgain::prepare(const SessionRecord& record, const Protocol& protocol) {
    const std::vector<RecordedOption> options = record.run_options(1);
    RunOptions run;
    take_recorded_options(options, run);
    const BakeQuality least = run.quality.value_or(protocol.bake.least(!run.simulate_observer));
    prepare_maps_alone(*library_, MapsNow::made, protocol);
    try {
        prepare_stimuli(*library_, MapsNow::made, least);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

ContextChoice context_of(const SessionHeader& header) {
    return header.graphics.context == name_of(ContextKind::egl) ? ContextKind::egl : ContextKind::osmesa;
}

fs::path cache_without_maps(const fs::path& cache, const fs::path& work) {
    fs::create_directories(work);
    fs::create_directories(cache / "frames");
    fs::create_directory_symlink(fs::absolute(cache / "frames"), work / "frames");
    return work;
}

} // namespace overt
