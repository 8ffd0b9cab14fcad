#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "devices/simulated/simulated_observer.h"

namespace overt {

namespace {

struct AnswersToTask {
    std::string_view task_id; ///< empty: any other task
    double median_s;          ///< from the question to the end of the answer
    std::array<std::string_view, 4> texts;
};

constexpr double answer_log_sd = 0.35, shortest_answer_s = 0.8, longest_answer_s = 45.0;
constexpr double reading_median_s = 2.5, reading_log_sd = 0.3, shortest_reading_s = 0.8,
                 longest_reading_s = 15.0;

/// From the question to the voice.
constexpr double voice_median_s = 0.7, voice_log_sd = 0.3, shortest_voice_s = 0.25, longest_voice_s = 3.0;

constexpr AnswersToTask answers[] = {
    {"free", 4.0, {"I have finished.", "I looked all around it.", "Done.", "A figure, turning slowly."}},
    {"material",
     6.0,
     {"Polished metal, perhaps gold.", "Some dull metal, like brushed brass.", "Metal with a lacquer on it.",
      "It looks like bronze."}},
    {"age", 4.0, {"About twenty-five.", "Around forty.", "An old person, over sixty.", "In the thirties."}},
    {"thoughts",
     12.0,
     {"Remembering somebody from long ago.", "About what to do next.", "Nothing much, just resting.",
      "Working out a difficult question."}},
    {"clothes",
     10.0,
     {"A long loose robe.", "A cloak over one shoulder.", "Hardly any, a cloth around the hips.",
      "A tunic with a belt."}},
    {"pose",
     9.0,
     {"Upright, with the head turned aside.", "Leaning forward a little.", "One arm up, the other hanging.",
      "Seated, looking down."}},
    {"", 7.0, {"I am not sure.", "I would say yes.", "It is hard to tell.", "There is little to say."}},
};

const AnswersToTask& answers_to(std::string_view task_id) {
    for (const AnswersToTask& to_task : answers) {
        if (to_task.task_id == task_id)
            return to_task;
    }
    return std::end(answers)[-1];
}

} // namespace

SimulatedAnswer SimulatedObserver::answer_to(const Trial& trial) const {
    const AnswersToTask& to_task = answers_to(scene_.tasks[static_cast<std::size_t>(trial.task)].id);
    RandomStream random(seed_, "answers", static_cast<std::uint64_t>(trial.index));
    const double after_s =
        log_normal_within(random, to_task.median_s, answer_log_sd, shortest_answer_s, longest_answer_s);
    const std::string_view text =
        to_task.texts[random.below(static_cast<std::uint32_t>(to_task.texts.size()))];
    // Streams of their own, so that a voice moves no key.
    RandomStream spoken(seed_, "voice", static_cast<std::uint64_t>(trial.index));
    const double voice_s =
        std::min(log_normal_within(spoken, voice_median_s, voice_log_sd, shortest_voice_s, longest_voice_s),
                 0.5 * after_s);
    return {from_seconds(after_s), from_seconds(voice_s),
            from_seconds(std::max(voice_s + 0.2, after_s - 0.3)), std::string(text)};
}

SessionDuration SimulatedObserver::reading_time(int count) const {
    RandomStream random(seed_, "reading", static_cast<std::uint64_t>(count));
    return from_seconds(
        log_normal_within(random, reading_median_s, reading_log_sd, shortest_reading_s, longest_reading_s));
}

} // namespace overt
