#include "experiment/record/bids/bids_answers.h"

#include <fmt/format.h>

#include "experiment/base/content_hash.h"
#include "experiment/base/error.h"
#include "experiment/base/output_file.h"
#include "experiment/base/path_inside.h"

namespace fs = std::filesystem;

namespace overt {

int count_answers(const SessionRecord& record, int run) {
    int answers = 0;
    for (const TrialRecord& trial : record.trials())
        answers += trial.sitting == run && record.answer_recording(trial).has_value();
    return answers;
}

void copy_bids_answers(const SessionRecord& record, int run, const BidsNames& names,
                       const fs::path& sourcedata) {
    const fs::path folder = sourcedata / names.folder();
    fs::create_directories(folder);
    std::string table = "file\ttrial\tattempt\tonset_sample\tsampling_frequency\n";
    for (const TrialRecord& trial : record.trials()) {
        const auto answer = trial.sitting == run ? record.answer_recording(trial) : std::nullopt;
        if (!answer)
            continue;
        const std::string file = fmt::format("{}_trial-{:03}_attempt-{}_answer.wav", names.run_stem(run),
                                             trial.trial.index + 1, trial.attempt);
        std::error_code error;
        const fs::path spoken = require_file_inside(record.directory(), answer->file);
        if (!answer->sha256.empty() && hash_of_file(spoken) != answer->sha256)
            throw RecordError(
                fmt::format("{}: is not the answer that was recorded. Export without the answers, or "
                            "see with `overt verify` what was changed.",
                            spoken.string()));
        fs::copy_file(spoken, folder / file, error);
        if (error)
            throw RecordError(
                fmt::format("{}: cannot be copied to {}: {}. Export without the answers, or see "
                            "with `overt verify` what the session lacks.",
                            (record.directory() / answer->file).string(), folder.string(), error.message()));
        table += fmt::format("{}\t{}\t{}\t{:.3f}\t{}\n", file, trial.trial.index + 1, trial.attempt,
                             answer->onset_sample, answer->sample_rate_hz);
    }
    write_text_file(folder / (names.run_stem(run) + "_answers.tsv"), table);
}

} // namespace overt
