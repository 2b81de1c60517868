// solver/visibility/area/kronrod_rule.h
//
// Gauss rules and their Kronrod extensions (Kronrod 1965; the numbers are from QUADPACK, Piessens et al.
// 1983). The sample points of a Gauss rule are also sample points of its Kronrod extension. For smooth
// integrands, |Gauss value - Kronrod value| exceeds the error of the Kronrod value.

#pragma once

#include <array>
#include <cstddef>

namespace penumbra {

// Nodes and weights of a Kronrod rule and its Gauss rule on [0, 1]. The nodes of the Gauss rule are the nodes
// of odd index; the weight gauss[i] is 0 for even i.
template <std::size_t N>
struct KronrodRule {
  std::array<double, N> node, kronrod, gauss;
};

// Makes a quadrature rule on [0, 1] from a symmetric rule on [-1, 1]. The parameters are the nodes of the
// symmetric rule in [0, 1), in descending order, so that the last node is 0, and the weights of these nodes.
template <std::size_t N>
constexpr KronrodRule<N> MakeKronrodRule(const std::array<double, (N + 1) / 2>& node,
                                         const std::array<double, (N + 1) / 2>& kronrod,
                                         const std::array<double, (N + 1) / 2>& gauss) {
  KronrodRule<N> rule{};
  for (std::size_t i = 0; i < (N + 1) / 2; ++i) {
    rule.node[i] = 0.5 - 0.5 * node[i];
    rule.node[N - 1 - i] = 0.5 + 0.5 * node[i];
    rule.kronrod[i] = rule.kronrod[N - 1 - i] = 0.5 * kronrod[i];
    rule.gauss[i] = rule.gauss[N - 1 - i] = 0.5 * gauss[i];
  }
  return rule;
}

inline constexpr KronrodRule<7> kSeven =
    MakeKronrodRule<7>({0.96049126870802028, 0.77459666924148338, 0.43424374934680256, 0},
                       {0.10465622602646727, 0.26848808986833344, 0.40139741477596222, 0.45091653865847414},
                       {0, 0.55555555555555556, 0, 0.88888888888888889});
inline constexpr KronrodRule<15> kFifteen = MakeKronrodRule<15>(
    {0.99145537112081264, 0.94910791234275852, 0.86486442335976907, 0.74153118559939444, 0.58608723546769113,
     0.40584515137739717, 0.20778495500789847, 0},
    {0.022935322010529225, 0.063092092629978553, 0.10479001032225018, 0.14065325971552592,
     0.16900472663926790, 0.19035057806478541, 0.20443294007529889, 0.20948214108472783},
    {0, 0.12948496616886969, 0, 0.27970539148927667, 0, 0.38183005050511894, 0, 0.41795918367346939});

}  // namespace penumbra
