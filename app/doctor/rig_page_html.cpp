#include "app/doctor/rig_page_html.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/doctor/first_day_steps.h"
#include "first_day_style.h"

namespace overt {
namespace {

/// Where text stands between tags or in an attribute.
std::string for_html(std::string_view text) {
    std::string safe;
    for (const char c : text)
        switch (c) {
        case '&':
            safe += "&amp;";
            break;
        case '<':
            safe += "&lt;";
            break;
        case '"':
            safe += "&quot;";
            break;
        default:
            safe += c;
        }
    return safe;
}

std::string title_of(const RigStep& step) {
    const auto all = first_day_steps();
    const auto found = std::ranges::find(all, step.name, &FirstDayStep::name);
    return std::string(found == all.end() ? std::string_view(step.name) : found->title);
}

/// "<= 1" is "at most 1".
std::string in_words(const std::string& target) {
    for (const auto& [sign, words] :
         {std::pair<std::string_view, std::string_view>{"<= ", "at most "}, {">= ", "at least "}})
        if (target.starts_with(sign))
            return std::string(words) + target.substr(sign.size());
    return target;
}

/// "2026-11-27T14:44:58Z" is "2026-11-27, 14:44 UTC".
std::string day_and_time(const std::string& utc) {
    constexpr std::size_t day = 10, minute = 16;
    return utc.size() > minute && utc[day] == 'T'
               ? fmt::format("{}, {} UTC", utc.substr(0, day), utc.substr(day + 1, minute - day - 1))
               : utc;
}

std::string verdict_mark(const RigStep& step) {
    return fmt::format("<span class=\"verdict {}\">{}{}</span>",
                       step.verdict == StepVerdict::proved   ? "good"
                       : step.verdict == StepVerdict::failed ? "bad"
                                                             : "open",
                       name_of(step.verdict), step.is_simulated ? ", simulated" : "");
}

std::string figures_table(const RigStep& step) {
    if (step.figures.empty())
        return {};
    std::string rows;
    for (const BenchFigure& figure : step.figures) {
        const double rounded = std::round(figure.value * 1e4) / 1e4;
        rows += fmt::format("<tr><td>{}</td><td class=\"number\">{:.7g} {}</td><td>{}</td><td>{}</td></tr>\n",
                            for_html(figure.figure), rounded, for_html(figure.unit),
                            for_html(in_words(figure.target)),
                            !figure.holds   ? ""
                            : *figure.holds ? "holds"
                                            : "<b>does not hold</b>");
    }
    return "<table><thead><tr><th>measured</th><th class=\"number\">value</th><th>has to "
           "be</th><th></th></tr></thead><tbody>\n" +
           rows + "</tbody></table>\n";
}

std::string step_section(const RigStep& step) {
    std::string html = fmt::format("<h3 id=\"{}\">{} {}</h3>\n", for_html(step.name),
                                   for_html(title_of(step)), verdict_mark(step));
    if (!step.finding.empty())
        html += fmt::format("<p>{}</p>\n", for_html(step.finding));
    if (!step.remedy.empty())
        html += fmt::format("<p class=\"remark\">To do: {}.</p>\n", for_html(step.remedy));
    html += figures_table(step);
    if (!step.measured_utc.empty()) {
        std::string facts;
        for (const RigFact& fact : step.facts)
            facts += fmt::format("; {}: {}", fact.what, fact.is);
        html += fmt::format("<p class=\"note\">Measured {}{}.</p>\n",
                            for_html(day_and_time(step.measured_utc)), for_html(facts));
    }
    return html;
}

int count_of(const RigPage& page, StepVerdict verdict) {
    return static_cast<int>(std::ranges::count(page.steps, verdict, &RigStep::verdict));
}

std::string card(int number, const char* what) {
    return fmt::format("<div class=\"card\"><b>{}</b><span>{}</span></div>\n", number, what);
}

/// The steps in the order of the day, each leading to its part.
std::string table_of_the_day(const RigPage& page) {
    std::string rows;
    for (const RigStep& step : page.steps)
        rows += fmt::format("<tr><td><a href=\"#{}\">{}</a></td><td>{}</td></tr>\n", for_html(step.name),
                            for_html(title_of(step)), verdict_mark(step));
    return "<table class=\"day\"><tbody>\n" + rows + "</tbody></table>\n";
}

std::string part(const RigPage& page, const char* id, const char* title, const char* nothing,
                 std::initializer_list<StepVerdict> verdicts) {
    std::string sections;
    for (const StepVerdict verdict : verdicts)
        for (const RigStep& step : page.steps)
            if (step.verdict == verdict)
                sections += step_section(step);
    return fmt::format("<section id=\"{}\"><h2>{}</h2>\n{}</section>\n", id, title,
                       sections.empty() ? fmt::format("<p>{}</p>\n", nothing) : sections);
}

constexpr const char* own_style = R"(
header, main, footer { max-width: 1100px; }
table { border-collapse: collapse; font-size: 15px; margin: 6px 0 10px; width: 100%; table-layout: fixed; }
th, td { text-align: left; padding: 3px 14px 3px 0; border-bottom: 1px solid var(--line); }
th:first-child { width: 50%; } th:nth-child(2) { width: 20%; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
thead th { padding-right: 14px; }
.day { table-layout: auto; width: auto; margin-top: 14px; }
.day a { color: var(--mark); text-decoration: none; }
.verdict { font-weight: 600; font-size: 14px; padding: 1px 8px; border-radius: 6px; background: var(--tint); }
.verdict.good { color: var(--c2); } .verdict.bad { color: var(--c5); } .verdict.open { color: var(--warn); }
)";

} // namespace

std::string rig_page_html(const RigPage& page) {
    const std::string title = fmt::format("What is proved on this rig, {}", day_and_time(page.begun_utc));
    std::string html =
        fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                    "<link rel=\"icon\" href=\"data:,\">\n<title>{}</title>\n<style>\n",
                    for_html(title));
    html += embedded::report_css;
    html += own_style;
    html += fmt::format("</style>\n</head>\n<body>\n<header>\n<h1>{}</h1>\n<p class=\"lead\">Measured by "
                        "overt doctor --first-day "
                        "for the protocol {}; {}.{}</p>\n</header>\n<main>\n",
                        for_html(title), for_html(page.protocol), for_html(page.program),
                        page.is_finished() ? "" : " THE DAY IS NOT FINISHED: steps are open.");
    html += "<section id=\"glance\"><h2>At a glance</h2>\n<div class=\"cards\">\n" +
            card(count_of(page, StepVerdict::proved), "proved") +
            card(count_of(page, StepVerdict::failed), "measured and failed") +
            card(count_of(page, StepVerdict::not_proved), "not proved") +
            card(count_of(page, StepVerdict::open), "not done yet") + "</div>\n" + table_of_the_day(page) +
            "</section>\n";
    html += part(page, "failed", "Measured and failed", "Nothing.", {StepVerdict::failed});
    html += part(page, "not_proved", "Not proved", "Nothing.", {StepVerdict::not_proved, StepVerdict::open});
    html += part(page, "proved", "Proved", "Nothing.", {StepVerdict::proved});
    html += "</main>\n<footer><p class=\"note\">What is proved holds for this rig as it is named below each "
            "step. "
            "Each session's record names this page, and says if its rig is "
            "another.</p></footer>\n</body>\n</html>\n";
    return html;
}

} // namespace overt
