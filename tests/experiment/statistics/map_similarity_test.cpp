#include "experiment/statistics/map_similarity.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "experiment/statistics/area_under_curve.h"

namespace {

using namespace overt;
using Values = std::vector<double>;

// Reference numbers in this file: numpy 1.24, with the formulas of the MIT benchmark's MATLAB code
// (code_forMetrics: CC, similarity, KLdiv, NSS, AUC_Judd without jitter, AUC_Borji) and of pysaliency written
// out, on the same maps and fixations.
struct Example {
    Values p, q, equal = Values(40, 1.0), areas, whole;
    std::vector<std::size_t> fixations{1, 3, 4, 8, 13, 21, 34, 20, 20, 7};
    Example() {
        for (int i = 0; i < 40; ++i) {
            p.push_back(std::abs(std::sin(1.3 * i + 0.2)) + 0.1 * std::pow(std::cos(0.7 * i), 2));
            q.push_back(std::pow(std::abs(std::cos(0.9 * i)), 3) + 0.05);
            areas.push_back(1.0 + 0.5 * std::sin(2.1 * i));
            whole.push_back(i % 3 + 1.0);
        }
    }
    Values at_fixations(const Values& map) const {
        Values values;
        for (const std::size_t i : fixations)
            values.push_back(map[i]);
        return values;
    }
};

const auto same = [](double value) { return Approx(value).margin(1e-12).epsilon(1e-9); };

TEST_CASE("similarities of maps are those of the reference formulas", "[unit]") {
    const Example of;
    CHECK(*correlation(of.p, of.q, of.equal) == same(-0.05039910455817406));
    CHECK(*similarity(of.p, of.q, of.equal, SimConvention::mit) == same(0.5861451466576988));
    CHECK(*similarity(of.p, of.q, of.equal, SimConvention::pysaliency) == same(0.6271669293190969));
    CHECK(*kl_divergence(of.p, of.q, of.equal) == same(0.5378936364277844));
    Values lower = of.p;
    for (double& value : lower)
        value -= 0.5;
    CHECK(*similarity(lower, of.q, of.equal, SimConvention::pysaliency) == same(0.623199387504215));
}

TEST_CASE("what a map says of fixations is that of the reference formulas", "[unit]") {
    const Example of;
    const Values p = of.at_fixations(of.p), q = of.at_fixations(of.q);
    CHECK(*nss(of.p, of.equal, p) == same(0.3361988144492499));
    CHECK(*nss(of.p, of.equal, p, NssConvention::sample) == same(0.33196973019562204));
    CHECK(*information_gain(of.p, of.q, of.equal, p, q) == same(0.024680918544972473));
    // The benchmark's fixation map holds each place once.
    Values once = p;
    once.erase(once.begin() + 8);
    CHECK(*auc_judd(of.p, of.equal, once) == same(0.6827956989247311));
}

TEST_CASE("a split of AUC-Borji is that of the reference formula", "[unit]") {
    const Example of;
    const auto [least, most] = std::minmax_element(of.p.begin(), of.p.end());
    Values scaled, others;
    for (const double value : of.p)
        scaled.push_back((value - *least) / (*most - *least));
    for (const std::size_t i : {0, 2, 5, 9, 11, 17, 30, 31, 33, 39})
        others.push_back(scaled[i]);
    CHECK(auc_by_steps(of.at_fixations(scaled), others, 0.1) == same(0.67));
}

TEST_CASE("areas weigh places as if they were there so many times", "[unit]") {
    const Example of;
    // numpy.cov(aweights = areas, ddof = 0), and numpy.repeat(map, areas) for whole ones.
    CHECK(*correlation(of.p, of.q, of.areas) == same(-0.1007188831261063));
    CHECK(*correlation(of.p, of.q, of.whole) == same(-0.0006472624516048439));
    CHECK(*similarity(of.p, of.q, of.whole, SimConvention::mit) == same(0.5957615663002045));
    CHECK(*similarity(of.p, of.q, of.whole, SimConvention::pysaliency) == same(0.6363514778333158));
    CHECK(*kl_divergence(of.p, of.q, of.whole) == same(0.4796726198785506));
}

TEST_CASE("a finer tessellation of the same surface changes no measure", "[unit]") {
    const Example of;
    Values p, q, areas;
    for (std::size_t i = 0; i < 40; ++i) {
        const std::size_t pieces = 1 + i % 4;
        for (std::size_t piece = 0; piece < pieces; ++piece) {
            p.push_back(of.p[i]);
            q.push_back(of.q[i]);
            areas.push_back(of.areas[i] / static_cast<double>(pieces));
        }
    }
    const Values at = of.at_fixations(of.p);
    CHECK(*correlation(p, q, areas) == same(*correlation(of.p, of.q, of.areas)));
    CHECK(*similarity(p, q, areas, SimConvention::mit) ==
          same(*similarity(of.p, of.q, of.areas, SimConvention::mit)));
    CHECK(*nss(p, areas, at) == same(*nss(of.p, of.areas, at)));
    CHECK(*kl_divergence(p, q, areas) == same(*kl_divergence(of.p, of.q, of.areas)));
}

TEST_CASE("a map is like itself, and unlike one that lies elsewhere", "[unit]") {
    const Example of;
    CHECK(*correlation(of.p, of.p, of.areas) == same(1.0));
    CHECK(*similarity(of.p, of.p, of.areas, SimConvention::mit) == same(1.0));
    CHECK(*kl_divergence(of.p, of.p, of.areas) == same(0.0));
    const Values left{1, 2, 0, 0}, right{0, 0, 3, 1}, areas{1, 2, 1, 1};
    CHECK(*similarity(left, right, areas, SimConvention::mit) == 0.0);
    CHECK(*correlation(left, right, areas) < -0.5);
}

TEST_CASE("maps of which a measure has no value give none", "[unit]") {
    const Values flat(4, 0.3), empty(4, 0.0), map{1, 2, 3, 4}, areas(4, 1.0), none;
    CHECK_FALSE(correlation(flat, map, areas));
    CHECK_FALSE(correlation(map, map, empty));
    CHECK_FALSE(similarity(flat, map, areas, SimConvention::mit));
    CHECK_FALSE(similarity(empty, map, areas, SimConvention::pysaliency));
    CHECK_FALSE(kl_divergence(empty, map, areas));
    CHECK_FALSE(nss(flat, areas, map));
    CHECK_FALSE(nss(map, areas, none));
    CHECK_FALSE(information_gain(map, empty, areas, map, map));
    CHECK_FALSE(auc_judd(map, areas, none));
    CHECK_FALSE(auc_judd(map, areas, map)); // every place was fixated
    CHECK_FALSE(auc_borji(flat, areas, map, 1));
}

TEST_CASE("AUC is a half for fixations anywhere, and nearly one for those on the peak", "[unit]") {
    Values map, areas;
    for (int i = 0; i < 2000; ++i) {
        map.push_back(std::exp(-0.5 * std::pow((i - 1000) / 50.0, 2)));
        areas.push_back(1.0 + 0.3 * std::cos(i));
    }
    Values anywhere, peak;
    for (std::size_t i = 0; i < 2000; i += 20)
        anywhere.push_back(map[i]);
    for (std::size_t i = 980; i < 1020; i += 4)
        peak.push_back(map[i]);
    CHECK(*auc_judd(map, areas, anywhere) == Approx(0.5).margin(0.02));
    // A constant map tells nothing, however many fixations it is asked of.
    const std::vector<double> constant(map.size(), 3.0), there(7, 3.0);
    CHECK(*auc_judd(constant, areas, there) == Approx(0.5).margin(1e-12));
    CHECK(*auc_judd(map, areas, peak) > 0.98);
    CHECK(*auc_borji(map, areas, peak, 3) > 0.9);
    CHECK(*auc_borji(map, areas, anywhere, 3) == Approx(0.5).margin(0.03));
    CHECK(*auc_borji(map, areas, peak, 3) == *auc_borji(map, areas, peak, 3));
    CHECK(*auc_borji(map, areas, anywhere, 3) != *auc_borji(map, areas, anywhere, 4));
}

} // namespace

TEST_CASE("a constant map tells no fixation from others, however it is rounded between its places",
          "[unit]") {
    const std::vector<double> map(400, 0.1 + 0.2), areas(400, 1.0);
    std::vector<double> there;
    for (int i = 0; i < 25; ++i)
        there.push_back((0.1 + 0.2) * (1.0 - 1e-16 * i));
    CHECK(*auc_judd(map, areas, there) == 0.5);
    std::vector<double> rounded = map;
    for (std::size_t i = 0; i < 400; i += 3)
        rounded[i] = 0.3;
    CHECK(*auc_judd(rounded, areas, there) == 0.5);
    CHECK_FALSE(auc_borji(rounded, areas, there, 1));
}
