/// Effect sizes, Bayes factors and tests of equivalence: numbers of R, and simulated studies whose effect is
/// known.
#include "experiment/statistics/paired_evidence.h"

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/statistics/distributions.h"

using namespace overt;

TEST_CASE("what stands beside the p of Student's sleep data is what R gives", "[unit]") {
    const std::vector<double> sleep{-1.2, -2.4, -1.3, -1.3, 0.0, -1.0, -1.8, -0.8, -4.6, -1.4};
    const PairedEvidence evidence = paired_evidence(sleep, 0.5);
    // BayesFactor::ttestBF(x = extra[1:10], y = extra[11:20], paired = TRUE).
    CHECK(*evidence.bayes_factor == Approx(17.25888).epsilon(1e-6));
    // gamma(4.5) / (sqrt(4.5) * gamma(4)) * mean(d) / sd(d); uniroot over pt(t, 9, ncp).
    CHECK(*evidence.effect_size.value == Approx(-1.173925).epsilon(1e-6));
    CHECK(evidence.effect_size.interval->low == Approx(-2.118017).epsilon(1e-6));
    CHECK(evidence.effect_size.interval->high == Approx(-0.4146278).epsilon(1e-6));
    CHECK(*evidence.equivalence_p == Approx(0.960174).epsilon(1e-6));
    std::vector<double> opposite = sleep;
    for (double& one : opposite)
        one *= -7.0;
    const PairedEvidence turned = paired_evidence(opposite, 0.5);
    CHECK(*turned.bayes_factor == Approx(*evidence.bayes_factor));
    CHECK(*turned.effect_size.value == Approx(-*evidence.effect_size.value));
    CHECK(*turned.equivalence_p == Approx(*evidence.equivalence_p));
}

TEST_CASE("Bayes factors and the noncentral t distribution are those of R", "[unit]") {
    // integrate() of Rouder's formula with rel.tol = 1e-12.
    CHECK(jzs_bayes_factor(0.5, 12) == Approx(0.32013839).epsilon(1e-7));
    CHECK(jzs_bayes_factor(2.2, 12) == Approx(1.65605931).epsilon(1e-7));
    CHECK(jzs_bayes_factor(-1.0, 6) == Approx(0.54659865).epsilon(1e-7));
    CHECK(jzs_bayes_factor(6.0, 50) == Approx(63996.74469362).epsilon(1e-7));
    CHECK(jzs_bayes_factor(0.0, 3) == Approx(0.46716128).epsilon(1e-7));
    // pt(t, df, ncp).
    CHECK(noncentral_student_probability(0.5, 11, 1.7) == Approx(0.1141909647).epsilon(1e-8));
    CHECK(noncentral_student_probability(2.2, 11, -1.2) == Approx(0.9989059726).epsilon(1e-8));
    CHECK(noncentral_student_probability(6.0, 49, 3.0) == Approx(0.9946807111).epsilon(1e-8));
    CHECK(noncentral_student_probability(1.0, 1, 0.5) == Approx(0.5927477364).epsilon(1e-8));
    CHECK(noncentral_student_probability(13.83, 1, 0.7071) == Approx(0.951194442).epsilon(1e-7));
    CHECK(noncentral_student_probability(80.0, 1, 0.7071) == Approx(0.991540428).epsilon(1e-7));
    CHECK(noncentral_student_probability(3.0, 200, 2.5) == Approx(0.6881976838).epsilon(1e-8));
    CHECK(noncentral_student_probability(-1.3, 7, 0.0) == Approx(student_probability(-1.3, 7)).epsilon(1e-8));
}

TEST_CASE("intervals of effect sizes hold the truth, and an effect as large as the bound is rarely called "
          "smaller",
          "[unit]") {
    for (const int observers : {6, 12}) {
        constexpr int studies = 500;
        int holding = 0, equivalent = 0;
        double mean = 0.0;
        for (int study = 0; study < studies; ++study) {
            RandomStream random(11, "effects", static_cast<std::uint64_t>(100 * study + observers));
            std::vector<double> differences;
            for (int i = 0; i < observers; ++i)
                differences.push_back(0.8 + random.normal());
            const PairedEvidence evidence = paired_evidence(differences, 0.8);
            holding += evidence.effect_size.interval->contains(0.8);
            equivalent += *evidence.equivalence_p <= 0.05;
            mean += *evidence.effect_size.value / studies;
        }
        CAPTURE(observers, holding, equivalent, mean);
        // Binomial: three standard deviations.
        CHECK(std::abs(holding - 475) <= 15);
        CHECK(equivalent <= 40);
        CHECK(mean == Approx(0.8).margin(0.08)); // Hedges' correction
    }
    // Many observers without an effect: it is smaller than what is of interest, and the factor says none.
    std::vector<double> none;
    for (int i = 0; i < 60; ++i)
        none.push_back(i % 2 == 0 ? 1.0 : -1.0);
    CHECK(*paired_evidence(none, 0.5).equivalence_p < 0.001);
    CHECK(*paired_evidence(none, 0.5).bayes_factor < 0.2);
}

TEST_CASE("of one observer, and of differences that are all the same, nothing is said but why", "[unit]") {
    const std::vector<double> one{0.4}, same{0.4, 0.4, 0.4}, two{0.4, 0.8};
    CHECK(paired_evidence(one, 0.5).effect_size.absent == "it takes two observers");
    CHECK_FALSE(paired_evidence(one, 0.5).bayes_factor);
    CHECK(paired_evidence(same, 0.5).effect_size.absent == "all observers have the same difference");
    CHECK_FALSE(paired_evidence(same, 0.5).equivalence_p);
    CHECK(paired_evidence(two, 0.5).effect_size.value);
    CHECK_FALSE(paired_evidence(two, 0.5).effect_size.interval);
    CHECK(paired_evidence(two, 0.5).bayes_factor);
}
