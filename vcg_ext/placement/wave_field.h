// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../carrier/wave_plan.h"

#include <Eigen/Cholesky>
#include <functional>

namespace vcg_ext {

/// Per site the displacement that moves the planes of its faces outward by one: the least of sum A_f (n_f . u - 1)^2.
///
/// The averaged normal would leave the sides of a crease behind and bend them where they end. Where all faces lie
/// nearly in one plane, the directions along it are left alone; no vector is longer than 3.
/// \param around see faces_around()
[[nodiscard]] Points offset_directions(const WaveBody& body, const VertexFaces& around);

/// The faces around each site, without fans.
[[nodiscard]] VertexFaces faces_around(const WaveBody& body);

[[nodiscard]] inline Points offset_directions(const WaveBody& body)
{
    return offset_directions(body, faces_around(body));
}

/// The least field along the surface that changes every m_k by a given amount: s = sum of a_k w_k, G a = 4 pi dm, where
/// w_k(v) is the mean of wave k around the site v (by its hat function) and G_kl = sum of A_v w_k w_l. Canonical units.
class WaveField {
public:
    /// \param around see faces_around()
    WaveField(const WaveBody& body, const WavePlan& plan, const VertexFaces& around);
    WaveField(const WaveBody& body, const WavePlan& plan) : WaveField(body, plan, faces_around(body)) {}

    /// s per site. \param change dm, per wave
    [[nodiscard]] std::vector<double> least(const std::vector<double>& change) const;

    /// RMS along the surface of the least field for `change`.
    [[nodiscard]] double size(const std::vector<double>& change) const;

    /// How much of a wave this mesh can make: 1 where its faces are small against the wave, to 0.
    [[nodiscard]] double reach(int wave) const;

    /// G.
    [[nodiscard]] const Eigen::MatrixXd& gram() const { return gram_; }

    /// The integrals over the surface of `functions(x)` times each wave, a row a function: over the sites of G.
    [[nodiscard]] Eigen::MatrixXd integrals(int rows,
                                            const std::function<Eigen::VectorXd(const Point&)>& functions) const;

    /// w_k(v) of the sites, row after row, one row a site.
    [[nodiscard]] std::vector<double> at_sites(const std::vector<int>& sites) const;

    /// w_k of all sites.
    [[nodiscard]] std::vector<double> wave(int k) const;

    /// Whether edges are so short against the waves that w_k(v) is the wave's value there.
    [[nodiscard]] bool fine() const { return values_.empty(); }

private:
    const WaveBody& body_;
    const WavePlan& plan_;
    std::vector<int> sampled_;    ///< sites of the sums
    std::vector<double> weights_; ///< of these: the areas that they stand for
    std::vector<double> values_;  ///< w_k(v), row after row, where the mesh is coarse; else the waves themselves do
    Eigen::MatrixXd gram_;
    Eigen::LLT<Eigen::MatrixXd> solver_;
    double area_ = 0;
};

} // namespace vcg_ext
