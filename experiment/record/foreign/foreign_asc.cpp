#include "experiment/record/foreign/foreign_asc.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/record/asc/asc_parser.h"
#include "experiment/record/asc/asc_trial.h"
#include "experiment/record/asc/asc_words.h"

namespace overt {
namespace {

constexpr std::string_view begin_of_viewer = "TRIALID", begin_of_opensesame = "start_trial",
                           end_of_viewer = "TRIAL_RESULT", end_of_opensesame = "end_trial",
                           end_of_pygaze = "stop_trial", viewer_onset = "SYNCTIME", viewer_command = "!V",
                           variable_of_viewer = "!V TRIAL_VAR", variable_of_opensesame = "var";

/// Whether a text begins with these words: "SYNCTIME 3" does with "SYNCTIME", "SYNCTIMES" does not.
bool begins_with(std::string_view text, std::string_view words) {
    return text.starts_with(words) && (text.size() == words.size() || is_blank(text[words.size()]));
}

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && is_blank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back()))
        text.remove_suffix(1);
    return text;
}

struct Late {
    std::int64_t ms = 0;
    std::string_view text; ///< behind the number
};

/// "-6 SYNCTIME" is late by -6 ms, as Data Viewer reads it. A number that is no such is part of the text.
Late lateness_of(std::string_view text) {
    std::int64_t ms = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ms);
    const auto length = static_cast<std::size_t>(end - text.data());
    constexpr std::int64_t most_ms = 60'000;
    if (error != std::errc() || length >= text.size() || !is_blank(text[length]) || std::abs(ms) > most_ms)
        return {0, text};
    return {ms, without_blanks(text.substr(length))};
}

GazeMark mark_of(const GazeEvent& message) {
    const Late late = lateness_of(message.text);
    if (begins_with(late.text, viewer_onset) || begins_with(late.text, viewer_command))
        return {message.start - std::chrono::milliseconds(late.ms), std::string(late.text), false};
    return {message.start, message.text, false};
}

class AscItems final : public AscListener {
  public:
    AscItems(std::function<void(const ForeignItem&)> take) : take_(std::move(take)) {}

    void header(std::string_view) override {}
    void samples(std::span<const GazeSample> samples) override {
        for (const GazeSample& sample : samples)
            take_({sample.sampled_at, sample, {}});
    }
    void event(const GazeEvent& event) override {
        if (event.kind != GazeEvent::Kind::message)
            return;
        const GazeMark mark = mark_of(event);
        take_({mark.at, std::nullopt, mark});
    }
    void malformed(std::int64_t, std::string_view, std::string_view) override {}

  private:
    std::function<void(const ForeignItem&)> take_;
};

AscFiles asc_files(const std::vector<std::filesystem::path>& files) {
    if (files.size() > 2)
        throw InputError(fmt::format("{}: a recording of an EyeLink is one file, or two, its samples and its "
                                     "events",
                                     files[2].string()));
    return files.size() == 1 ? AscFiles(files[0]) : AscFiles(files[0], files[1]);
}

/// What the messages of one trial say.
struct MessageTrial {
    std::string key;
    std::optional<TrackerTime> onset, end;
    std::map<std::string, std::string> variables;
    std::string picture;
};

void take_variable(MessageTrial& trial, std::string_view text) {
    text = without_blanks(text);
    const std::size_t length = std::min(text.find_first_of(" \t"), text.size());
    std::string_view value = without_blanks(text.substr(length));
    if (value.size() > 1 && value.front() == '"' && value.back() == '"')
        value = value.substr(1, value.size() - 2);
    trial.variables[std::string(text.substr(0, length))] = std::string(value);
}

/// The file of "!V IMGLOAD CENTER face.png 512 384", "!V IMGLOAD FILL face.png" or
/// "!V VFRAME 12 0 0 turn.avi": the one word that ends as a file does.
std::string picture_of(std::string_view text) {
    Words words(text);
    std::string picture;
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
        if (const std::size_t dot = word.rfind('.');
            dot != std::string_view::npos && dot + 1 < word.size() && !number_of(word))
            picture = std::string(word);
    return picture;
}

class MessageTrials {
  public:
    MessageTrials(std::string onset, std::string end, bool has_begins)
        : onset_(std::move(onset)), end_(std::move(end)), has_begins_(has_begins) {}

    void take(const GazeMark& mark) {
        const std::string_view text = mark.text;
        if (begins_with(text, begin_of_viewer) || begins_with(text, begin_of_opensesame)) {
            const std::size_t after = text.find_first_of(" \t");
            begin(after == std::string_view::npos ? "" : std::string(without_blanks(text.substr(after))));
            return;
        }
        const Late late = lateness_of(text);
        const std::string_view said = begins_with(text, onset_) || begins_with(text, end_) ? text : late.text;
        const TrackerTime at =
            said.size() == text.size() ? mark.at : mark.at - std::chrono::milliseconds(late.ms);
        if (begins_with(said, onset_)) {
            if (!has_begins_)
                begin("");
            if (is_open_ && !trials_.back().onset)
                trials_.back().onset = at;
            return;
        }
        if (!is_open_)
            return;
        MessageTrial& trial = trials_.back();
        if (!end_.empty() && begins_with(said, end_) && trial.onset && !trial.end)
            trial.end = at;
        if (begins_with(text, end_of_viewer) || begins_with(text, end_of_opensesame) ||
            begins_with(text, end_of_pygaze))
            is_open_ = !has_begins_;
        else if (begins_with(text, variable_of_viewer))
            take_variable(trial, text.substr(variable_of_viewer.size()));
        else if (begins_with(text, variable_of_opensesame))
            take_variable(trial, text.substr(variable_of_opensesame.size()));
        else if (trial.picture.empty() && (begins_with(text, "!V IMGLOAD") || begins_with(text, "!V VFRAME")))
            trial.picture = picture_of(text);
    }
    std::vector<MessageTrial>& trials() { return trials_; }

  private:
    void begin(std::string key) {
        trials_.push_back({std::move(key), {}, {}, {}, {}});
        is_open_ = true;
    }
    std::string onset_, end_;
    bool has_begins_, is_open_ = false;
    std::vector<MessageTrial> trials_;
};

/// The first words of messages, those that are there most often first, up to 12.
std::string first_words(const GazeSurvey& gaze) {
    std::map<std::string, int> counts;
    for (const GazeMark& mark : gaze.marks)
        if (const std::string_view word = Words(lateness_of(mark.text).text).next(); !word.empty())
            ++counts[std::string(word)];
    std::vector<std::pair<std::string, int>> sorted(counts.begin(), counts.end());
    std::ranges::stable_sort(sorted, std::ranges::greater(), &std::pair<std::string, int>::second);
    std::vector<std::string> words;
    for (const auto& [word, count] : sorted)
        if (words.size() < 12)
            words.push_back(fmt::format("{} ({})", word, count));
    return fmt::format("{}", fmt::join(words, ", "));
}

bool is_said(const GazeSurvey& gaze, std::string_view words) {
    return std::ranges::any_of(gaze.marks, [&](const GazeMark& mark) {
        return begins_with(mark.text, words) || begins_with(lateness_of(mark.text).text, words);
    });
}

std::string said_of(const GazeSurvey& gaze, const std::string& given,
                    std::initializer_list<std::string_view> usual) {
    if (!given.empty())
        return given;
    for (const std::string_view words : usual)
        if (is_said(gaze, words))
            return std::string(words);
    return {};
}

std::string variable_named(const std::string& given, const std::set<std::string>& variables,
                           std::initializer_list<const char*> usual) {
    if (!given.empty())
        return given;
    for (const char* name : usual)
        if (variables.contains(name))
            return name;
    return {};
}

std::string value_of(const MessageTrial& trial, const std::string& name) {
    const auto found = trial.variables.find(name);
    return found == trial.variables.end() || is_missing_cell(found->second) ? std::string() : found->second;
}

/// "512,384" or "-2.0,5.8".
std::optional<glm::dvec2> pair_in(std::string_view word) {
    const std::size_t comma = word.find(',');
    if (comma == std::string_view::npos)
        return std::nullopt;
    const auto x = number_of(word.substr(0, comma)), y = number_of(word.substr(comma + 1));
    return x && y ? std::optional(glm::dvec2(*x, *y)) : std::nullopt;
}

/// Of the words behind "VALIDATE"; nothing for a line that says otherwise.
std::optional<ValidatedTarget> validated_target(std::string_view text) {
    Words words(text);
    ValidatedTarget target;
    std::string_view word = words.next();
    while (!word.empty() && word != "LEFT" && word != "RIGHT")
        word = words.next();
    target.eye = word == "LEFT" ? Eye::left : Eye::right;
    if (word.empty() || words.next() != "at")
        return std::nullopt;
    const std::optional<glm::dvec2> place = pair_in(words.next());
    if (!place)
        return std::nullopt;
    target.target = {place->x, place->y};
    if (words.next() != "OFFSET")
        return target; // MISSING
    const std::optional<double> error_deg = number_of(words.next());
    words.next(); // deg.
    const std::optional<glm::dvec2> off = pair_in(words.next());
    if (!error_deg || *error_deg < 0.0 || !off)
        return std::nullopt;
    target.error = {*error_deg};
    target.gaze = ScreenPoint{place->x + off->x, place->y + off->y};
    return target;
}

/// The number between these words and a blank behind it.
std::optional<double> number_after(std::string_view text, std::string_view words) {
    const std::size_t at = text.find(words);
    return at == std::string_view::npos ? std::nullopt
                                        : number_of(Words(text.substr(at + words.size())).next());
}

} // namespace

bool is_asc_file(const std::filesystem::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".asc")
        return true;
    std::ifstream stream(file, std::ios::binary);
    std::string begin(18, '\0');
    stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    return begin == "** CONVERTED FROM ";
}

AscGaze::AscGaze(const std::vector<std::filesystem::path>& files, const GazeReading& reading)
    : files_(asc_files(files)), reading_(reading) {}

GazeSurvey AscGaze::survey(glm::dvec2 screen_px, const RowReport& report) const {
    AscSurveyOptions options;
    options.report = report;
    options.missing = reading_.missing;
    options.least_read = reading_.least_read;
    options.is_gaze = reading_.takes_any_gaze;
    const AscSurvey found = survey_asc(files_, options);
    GazeSurvey survey;
    const bool are_diameters = found.format.has_pupil_diameters && !found.format.has_pupil_areas;
    survey.columns.program = are_diameters ? "EyeLink (pupil diameters)" : "EyeLink";
    survey.columns.time = "its time";
    survey.columns.time_unit = "ms";
    survey.samples = found.samples;
    survey.without_gaze = found.samples_without_gaze;
    survey.rows_left_out = found.skipped_lines;
    survey.has_left = found.has_left;
    survey.has_right = found.has_right;
    survey.rate_hz = found.rate_hz;
    survey.tick = std::chrono::milliseconds(1); // of its messages
    // Many a program names the number of pixels where the last one belongs: "0 0 1024 768".
    const auto differ = [](double a, double b) { return std::abs(a - b) > 1.0; };
    if (found.screen_px &&
        (differ(found.screen_px->x, screen_px.x) || differ(found.screen_px->y, screen_px.y)))
        throw InputError(fmt::format(
            "{}: its gaze is in pixels of a screen of {} x {}, and the protocol's [display] has {} x {}: "
            "give width_px and height_px of the screen that was there, or gaze and surface do not go "
            "together",
            files_.path(), found.screen_px->x, found.screen_px->y, screen_px.x, screen_px.y));
    if (!found.screen_px)
        survey.remarks.emplace_back("The recording does not say how many pixels the screen had: it is taken "
                                    "for that of the protocol.");
    if (found.events_that_are_no_gaze == 0 && found.events > 0)
        survey.remarks.emplace_back("Fixations, saccades and blinks of the EyeLink's own are not taken over: "
                                    "they are found in its samples, as the protocol's [events] says.");
    bool has_first = false;
    read([&](const ForeignItem& item) {
        if (!item.sample) {
            survey.marks.push_back(item.mark);
            return;
        }
        survey.first = has_first ? std::min(survey.first, item.at) : item.at;
        survey.last = has_first ? std::max(survey.last, item.at) : item.at;
        has_first = true;
    });
    if (!has_first)
        throw InputError(fmt::format("{}: has no sample of gaze", files_.path()));
    std::ranges::stable_sort(survey.marks, {}, &GazeMark::at);
    return survey;
}

void AscGaze::read(const std::function<void(const ForeignItem&)>& take) const {
    AscItems items(take);
    AscParser parser(items, find_conventions(files_, reading_.missing));
    files_.parse(parser);
}

TrialLog trials_in_messages(const GazeSurvey& gaze, const TrialColumns& columns,
                            const std::vector<std::string>& factors, const std::filesystem::path& file) {
    const std::string onset = said_of(gaze, columns.onset, {viewer_onset, onset_message}),
                      end = said_of(gaze, columns.end, {end_message, earlier_end_message});
    if (onset.empty() || !is_said(gaze, onset))
        throw InputError(fmt::format("{}: no message {} says when a stimulus came: name the one that does, "
                                     "--trial-columns onset=TEXT, "
                                     "or give a log of trials, --trial-log FILE; its messages begin with {}",
                                     file.string(), onset.empty() ? std::string(viewer_onset) : onset,
                                     first_words(gaze)));
    MessageTrials found(onset, end, is_said(gaze, begin_of_viewer) || is_said(gaze, begin_of_opensesame));
    for (const GazeMark& mark : gaze.marks)
        found.take(mark);

    std::set<std::string> variables;
    for (const MessageTrial& trial : found.trials())
        for (const auto& [name, value] : trial.variables)
            variables.insert(name);
    const auto require_variable = [&](const std::string& name, std::string_view what) {
        if (!name.empty() && !variables.contains(name))
            throw InputError(fmt::format("{}: no trial has a variable \"{}\" for {}; there are {}",
                                         file.string(), name, what,
                                         variables.empty() ? "none (messages !V TRIAL_VAR NAME VALUE)"
                                                           : fmt::format("{}", fmt::join(variables, ", "))));
    };
    const std::string answer = variable_named(columns.answer, variables, {"answer", "response"}),
                      response_time = variable_named(columns.response_time, variables, {"response_time"}),
                      correct = variable_named(columns.correct, variables, {"correct_response"});
    require_variable(answer, "the answer");
    require_variable(response_time, "the response time");
    require_variable(correct, "the correct answer");
    std::map<std::string, std::string> words; // variable by factor
    for (const std::string& name : variables) {
        const std::string factor =
            name.substr(name.rfind('.') == std::string::npos ? 0 : name.rfind('.') + 1);
        if (std::ranges::find(factors, factor) != factors.end() || name == "stimulus")
            words[name] = name;
    }
    for (const auto& [factor, name] : columns.words) {
        require_variable(name, factor);
        words[factor] = name;
    }
    const double ns = ns_of_unit(columns.unit.empty() ? "ms" : columns.unit, "--trial-columns");

    TrialLog log;
    int without_onset = 0;
    for (const MessageTrial& trial : found.trials()) {
        if (!trial.onset) {
            ++without_onset;
            continue;
        }
        LoggedTrial logged;
        logged.place = fmt::format("{}, the trial whose stimulus came at {:.1f} ms", file.string(),
                                   1e-3 * static_cast<double>(trial.onset->time_since_epoch().count()));
        logged.onset = trial.onset->time_since_epoch();
        if (trial.end)
            logged.end = trial.end->time_since_epoch();
        logged.key = trial.key;
        logged.answer = value_of(trial, answer);
        logged.correct = value_of(trial, correct);
        if (const std::string text = value_of(trial, response_time); !text.empty()) {
            const std::optional<double> number = number_in_cell(text);
            if (!number)
                throw InputError(
                    fmt::format("{}: {} is \"{}\", and no number", logged.place, response_time, text));
            logged.response_time = LogTime(std::llround(*number * ns));
        }
        for (const auto& [factor, name] : words)
            if (std::string word = value_of(trial, name); !word.empty())
                logged.words[factor] = std::move(word);
        if (words.empty() && !trial.picture.empty())
            logged.words["stimulus"] = trial.picture;
        log.trials.push_back(std::move(logged));
    }
    if (log.trials.empty())
        throw InputError(fmt::format("{}: no trial (TRIALID) has a message {}", file.string(), onset));
    if (without_onset > 0)
        log.remarks.push_back(
            fmt::format("{} of {} trials of the recording have no message {} and are left out.",
                        without_onset, found.trials().size(), onset));
    std::ranges::stable_sort(log.trials, {}, &LoggedTrial::onset);
    return log;
}

std::vector<ToldValidation> validations_in_messages(std::span<const GazeMark> marks) {
    // Lines of one validation stand within some ms of each other.
    constexpr TrackerClock::duration together = std::chrono::seconds(1);
    std::vector<ToldValidation> all;
    std::vector<int> eyes; // with sums, of each
    for (const GazeMark& mark : marks) {
        const std::string_view text = mark.text;
        if (begins_with(text, "!CAL VALIDATION")) {
            const std::optional<double> mean_deg = number_after(text, "ERROR"),
                                        max_deg = number_after(text, "avg.");
            if (!mean_deg || !max_deg || *mean_deg < 0.0 || *max_deg < 0.0)
                continue; // ABORTED
            if (all.empty() || mark.at - all.back().at > together) {
                all.push_back({mark.at, {{0.0}, {0.0}, {}}});
                eyes.push_back(0);
            }
            ValidationResult& found = all.back().found;
            const int before = eyes.back()++;
            found.mean_error = {(found.mean_error.value * before + *mean_deg) / (before + 1)};
            found.max_error = {std::max(found.max_error.value, *max_deg)};
        } else if (begins_with(text, "VALIDATE") && !all.empty() && mark.at - all.back().at <= together) {
            if (const auto target = validated_target(text))
                all.back().found.targets.push_back(*target);
        }
    }
    for (ToldValidation& one : all)
        if (ValidationResult summed = one.found; summed.sum_up() > 0)
            one.found = summed;
    return all;
}

} // namespace overt
