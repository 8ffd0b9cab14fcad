#include "app/inputs/prepared_stimuli.h"

#include "app/cli/interruption.h"
#include "app/cli/progress_bar.h"
#include "experiment/base/error.h"

namespace overt {

void prepare_stimuli(StimulusLibrary& library, MapsNow maps, BakeQuality least) {
    ProgressBar bar;
    const Progress show = [&](std::string_view what, int done, int total, double share) {
        bar.update(what, done, total, share);
        if (Interruption::requested())
            throw Error(
                "interrupted while the stimuli were made ready: no trial was begun. What was finished "
                "is kept, and the same command goes on from there.");
    };
    if (maps == MapsNow::made)
        library.maps().prepare_maps(show);
    library.maps().prepare_given_maps(show);
    library.prepare_frames(show, least);
}

} // namespace overt
