#include "app/inputs/prepared_stimuli.h"

#include <cstdio>

#include <fmt/format.h>

#include "app/cli/interruption.h"
#include "app/cli/progress_bar.h"
#include "experiment/base/error.h"

namespace overt {

namespace {

/// With a progress bar; `work` is given what to tell.
template <class Work> void with_bar(const std::function<void()>& meanwhile, const Work& work) {
    ProgressBar bar;
    const Progress show = [&](std::string_view what, int done, int total, double share) {
        bar.update(what, done, total, share);
        if (meanwhile)
            meanwhile();
        if (Interruption::requested())
            throw Error(
                "interrupted while the stimuli were made ready: no trial was begun. What was finished "
                "is kept, and the same command goes on from there.");
    };
    work(show);
}

void make_maps(StimulusLibrary& library, MapsNow maps, const Progress& show) {
    if (maps == MapsNow::made)
        library.maps().prepare_maps(show);
    library.maps().prepare_given_maps(show);
}

/// Of all stimuli with a surface: the session keeps it for the analysis.
void make_light(StimulusLibrary& library, const Progress& show) {
    const std::vector<Stimulus> stimuli = library.cache().stimuli_with_surface();
    const int count = static_cast<int>(stimuli.size());
    for (int done = 0; done < count; ++done) {
        show("light of the stimuli", done, count, static_cast<double>(done) / count);
        library.light_file(stimuli[static_cast<std::size_t>(done)], true);
    }
    if (count > 0)
        show("light of the stimuli", count, count, 1.0);
}

/// Of all stimuli: the session keeps them for looking at.
void make_first_frames(StimulusLibrary& library) {
    for (const Stimulus& stimulus : stimuli_in_slots(library.cache().protocol()))
        library.first_frame_file(stimulus);
}

} // namespace

void prepare_stimuli(StimulusLibrary& library, MapsNow maps, BakeQuality least,
                     const std::function<void()>& meanwhile) {
    with_bar(meanwhile, [&](const Progress& show) {
        make_maps(library, maps, show);
        library.prepare_frames(show, least);
        for (const std::string& remark : library.remarks())
            fmt::print(stderr, "\n{}\n", remark);
        make_light(library, show);
        make_first_frames(library);
    });
}

void prepare_maps_alone(StimulusLibrary& library, MapsNow maps, const Protocol& protocol,
                        const std::function<void()>& meanwhile) {
    with_bar(meanwhile, [&](const Progress& show) { make_maps(library, maps, show); });
    const BakeQuality least = protocol.bake.least(false);
    library.take_frames(library.quality_of_session(least).value_or(quality_of(least, protocol.bake)));
}

} // namespace overt
