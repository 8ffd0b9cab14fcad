#include "experiment/fits/gauge_relief.h"
#include "experiment/fits/matching.h"
#include "experiment/proving/known_table.h"

#include <numbers>

#include "known_answer_tables.h"

namespace overt {

namespace {

void add_relief(KnownAnswers& answers) {
    constexpr double radius_px = 100.0;
    const KnownTable table(embedded::gauge_nodes_csv), set(embedded::gauge_settings_csv);
    std::vector<ReliefNode> nodes;
    std::vector<double> true_z;
    for (std::size_t row = 0; row < table.size(); ++row) {
        nodes.push_back({table.number(row, "x_px"), table.number(row, "y_px")});
        true_z.push_back(table.number(row, "z_true"));
    }
    std::vector<GaugeSetting> settings;
    double sum = 0.0, largest = 0.0;
    WorstAnswer first("gauge: angle to the true normal, degrees", 1e-6);
    constexpr double first_three[] = {8.769668, 9.831645, 12.985307};
    for (std::size_t row = 0; row < set.size(); ++row) {
        const auto node = [&](const char* column) {
            return static_cast<std::size_t>(set.number(row, column));
        };
        settings.push_back({{node("n0"), node("n1"), node("n2")},
                            set.number(row, "slant_deg"),
                            set.number(row, "tilt_deg")});
        const double x = set.number(row, "x_px"), y = set.number(row, "y_px"),
                     degrees = 180.0 / std::numbers::pi;
        const double angle =
            normal_angle_deg(settings.back().slant_deg, settings.back().tilt_deg,
                             std::asin(std::hypot(x, y) / radius_px) * degrees, std::atan2(y, x) * degrees);
        sum += angle;
        largest = std::max(largest, angle);
        if (row < 3)
            first.add(first_three[row], angle);
    }
    answers.push_back(first.answer());
    answers.push_back({"gauge: mean angle to the true normals, degrees", 9.394804,
                       sum / static_cast<double>(set.size()), 1e-6});
    answers.push_back({"gauge: largest angle to a true normal, degrees", 14.496093, largest, 1e-6});
    const std::optional<GaugeRelief> relief = gauge_relief(nodes, settings);
    if (!relief) {
        answers.push_back({"gauge: relief", 1.0, 0.0, 0.0});
        return;
    }
    WorstAnswer depth("gauge: z of a node", 1e-6);
    for (std::size_t row = 0; row < table.size(); ++row)
        depth.add(table.number(row, "z_lsq"), relief->z[row]);
    answers.push_back(depth.answer());
    answers.push_back({"gauge: residual sum of squares", 9.397688, relief->residual_sum, 1e-6});
    answers.push_back({"gauge: equations", 72, static_cast<double>(relief->equations), 0.0});
    const ReliefAgreement agreement = compare_relief(nodes, relief->z, true_z).value_or(ReliefAgreement{});
    answers.push_back({"gauge: gain", 0.707656, agreement.gain, 1e-6});
    answers.push_back({"gauge: R2", 0.242104, agreement.r_squared, 1e-6});
    answers.push_back({"gauge: affine gain", 0.707656, agreement.affine_gain, 1e-6});
    answers.push_back({"gauge: shear in x", 0.150271, agreement.x_shear, 1e-6});
    answers.push_back({"gauge: shear in y", -0.048551, agreement.y_shear, 1e-6});
    answers.push_back({"gauge: affine R2", 0.998312, agreement.affine_r_squared, 1e-6});
}

} // namespace

KnownAnswers known_matches() {
    const std::vector<MatchSettings> settings{{0.05, {0.062, 0.055, 0.060, 0.058}},
                                              {0.10, {0.115, 0.108, 0.121, 0.104}},
                                              {0.15, {0.158, 0.171, 0.149, 0.166}},
                                              {0.20, {0.219, 0.205, 0.213, 0.198}},
                                              {0.25, {0.251, 0.262, 0.244, 0.270}}};
    const std::vector<MatchEstimate> matches = match_estimates(settings);
    constexpr double equal[] = {0.05875, 0.112, 0.161, 0.20875, 0.25675};
    constexpr double spread[] = {0.002986, 0.007528, 0.009626, 0.009179, 0.011529};
    WorstAnswer means("matches: point of equality", 1e-9), sds("matches: SD", 5e-7);
    for (std::size_t i = 0; i < matches.size(); ++i) {
        means.add(equal[i], matches[i].point_of_equality);
        sds.add(spread[i], matches[i].sd.value_or(NAN));
    }
    KnownAnswers answers{means.answer(), sds.answer()};
    const MatchLine line = least_squares_line(settings).value_or(MatchLine{NAN, NAN});
    const MatchLine deming = deming_line(settings).value_or(MatchLine{NAN, NAN});
    answers.push_back({"matches: least squares, slope", 0.985500, line.slope, 5e-7});
    answers.push_back({"matches: least squares, intercept", 0.011625, line.intercept, 5e-7});
    answers.push_back({"matches: Deming, slope", 0.991387, deming.slope, 5e-7});
    answers.push_back({"matches: Deming, intercept", 0.010742, deming.intercept, 5e-7});
    answers.push_back({"matches: Brunswik ratio", 0.666667, brunswik_ratio(0.38, 0.30, 0.42), 5e-7});
    answers.push_back({"matches: Thouless ratio", 0.702551, thouless_ratio(0.38, 0.30, 0.42), 5e-7});
    add_relief(answers);
    return answers;
}

KnownAnswers known_answers() {
    KnownAnswers all;
    for (const auto part : {known_staircases, known_quest, known_quest_plus, known_psychometric_fits,
                            known_scales, known_detection, known_matches}) {
        const KnownAnswers some = part();
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

} // namespace overt
