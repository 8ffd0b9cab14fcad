#include "app/rig/rig_page.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "app/cli/own_folders.h"
#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/base/whole_file.h"

namespace overt {
namespace {

using PageJson = nlohmann::ordered_json;

PageJson json_of(const RigStep& step) {
    PageJson json{{"step", step.name},
                  {"verdict", name_of(step.verdict)},
                  {"simulated", step.is_simulated},
                  {"finding", step.finding},
                  {"remedy", step.remedy},
                  {"measured_utc", step.measured_utc}};
    json["figures"] = to_json(step.figures)["figures"];
    json["rig"] = PageJson::object();
    for (const RigFact& fact : step.facts)
        json["rig"][fact.what] = fact.is;
    return json;
}

/// Throws what the library throws for what is not there or is something else.
RigStep step_from(const PageJson& json) {
    const auto text = [&](const char* name) { return json.at(name).get<std::string>(); };
    RigStep step;
    step.name = text("step");
    const auto& names = names_of<StepVerdict>;
    const auto verdict = std::ranges::find(names, text("verdict"));
    if (verdict == names.end())
        throw Error("no verdict");
    step.verdict = static_cast<StepVerdict>(verdict - names.begin());
    step.is_simulated = json.at("simulated").get<bool>();
    step.finding = text("finding");
    step.remedy = text("remedy");
    step.measured_utc = text("measured_utc");
    for (const PageJson& one : json.at("figures")) {
        BenchFigure figure{one.at("figure").get<std::string>(), one.at("value").get<double>(),
                           one.at("unit").get<std::string>()};
        if (one.contains("target")) {
            figure.target = one.at("target").get<std::string>();
            figure.holds = one.at("holds").get<bool>();
        }
        step.figures.push_back(std::move(figure));
    }
    for (const auto& [what, is] : json.at("rig").items())
        step.facts.push_back({what, is.get<std::string>()});
    return step;
}

/// "light, screen" of those that are asked for; empty if there are none.
std::string names_where(const RigPage& page, const std::function<bool(const RigStep&)>& is_meant) {
    std::vector<std::string> names;
    for (const RigStep& step : page.steps)
        if (is_meant(step))
            names.push_back(step.name);
    return fmt::format("{}", fmt::join(names, ", "));
}

} // namespace

bool RigPage::is_finished() const {
    return std::ranges::none_of(steps, [](const RigStep& step) { return step.verdict == StepVerdict::open; });
}

std::filesystem::path rig_folder() { return state_folder() / "rig"; }
std::filesystem::path rig_page_file(const std::filesystem::path& folder) { return folder / "rig.json"; }

std::string to_json_text(const RigPage& page) {
    PageJson json{{"begun_utc", page.begun_utc},
                  {"protocol", page.protocol},
                  {"program", page.program},
                  {"finished", page.is_finished()},
                  {"steps", PageJson::array()}};
    for (const RigStep& step : page.steps)
        json["steps"].push_back(json_of(step));
    return json_text(json);
}

RigPage rig_page_from(const std::string& text, const std::filesystem::path& file) {
    const PageJson json = parse_json(text);
    try {
        RigPage page{json.at("begun_utc").get<std::string>(),
                     json.at("protocol").get<std::string>(),
                     json.at("program").get<std::string>(),
                     {}};
        for (const PageJson& step : json.at("steps"))
            page.steps.push_back(step_from(step));
        return page;
    } catch (const std::exception&) {
        throw InputError(fmt::format("{}: is no page of a rig as overt doctor --first-day keeps it: move it "
                                     "away, and begin anew",
                                     file.string()));
    }
}

std::optional<KeptRigPage> read_rig_page(const std::filesystem::path& folder) {
    const std::filesystem::path file = rig_page_file(folder);
    std::error_code unknown;
    if (!std::filesystem::exists(file, unknown))
        return std::nullopt;
    const std::string text = read_whole_file(file);
    return KeptRigPage{rig_page_from(text, file), file, hash_of_text(text)};
}

std::string sentence_of(const std::optional<KeptRigPage>& kept, const RigFacts& now) {
    if (!kept)
        return "none: nothing was measured on this rig by overt doctor --first-day";
    const RigPage& page = kept->page;
    const auto is_of_another = [&](const RigStep& step) {
        return !differences_between(step.facts, now).empty();
    };
    std::string text = fmt::format("begun {}{}, SHA-256 {}", page.begun_utc,
                                   page.is_finished() ? "" : ", not finished", kept->sha256);
    const auto add = [&](StepVerdict verdict) {
        const std::string names = names_where(page, [&](const RigStep& step) {
            return step.verdict == verdict && !(verdict == StepVerdict::proved && is_of_another(step));
        });
        if (!names.empty())
            text += fmt::format("; {}: {}", name_of(verdict), names);
    };
    for (const StepVerdict verdict :
         {StepVerdict::proved, StepVerdict::failed, StepVerdict::not_proved, StepVerdict::open})
        add(verdict);
    std::vector<std::string> changed;
    for (const RigStep& step : page.steps)
        for (std::string& difference : differences_between(step.facts, now))
            if (std::ranges::find(changed, difference) == changed.end())
                changed.push_back(std::move(difference));
    if (!changed.empty())
        text += fmt::format("; THE PAGE IS OF ANOTHER RIG: {}; measured there and not here: {}",
                            fmt::join(changed, "; "), names_where(page, is_of_another));
    return text;
}

} // namespace overt
