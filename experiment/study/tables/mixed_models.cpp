#include "experiment/study/tables/mixed_models.h"

#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/base/whole_file.h"
#include "experiment/study/factor_effects.h"
#include "model_scripts.h"

namespace overt {

void write_mixed_models(const StudyResults& results, const std::filesystem::path& folder,
                        TableFormat format) {
    std::string script(embedded::mixed_models_r);
    const auto put = [&](std::string_view mark, const std::string& text) {
        const std::size_t at = script.find(mark);
        OVERT_EXPECTS(at != script.npos);
        script.replace(at, mark.size(), text);
    };
    // Into a string of R: what ends one there is escaped.
    std::string factors;
    for (const char c : fmt::format("{}", fmt::join(tested_columns(results.by), ",")))
        factors += c == '"' || c == '\\' ? fmt::format("\\{}", c) : std::string(1, c);
    put("{{FACTORS}}", factors);
    put("{{AREA}}", results.area);
    put("{{TABLE}}", fmt::format("trials.{}", ending_of(format)));
    write_whole_file(folder / "mixed_models.R", script);
}

void write_answer_models(const std::filesystem::path& folder, TableFormat format) {
    std::string script(embedded::answer_models_r);
    constexpr std::string_view mark = "{{TABLE}}";
    const std::size_t at = script.find(mark);
    OVERT_EXPECTS(at != script.npos);
    script.replace(at, mark.size(), fmt::format("answer_trials.{}", ending_of(format)));
    write_whole_file(folder / "answer_models.R", script);
}

} // namespace overt
