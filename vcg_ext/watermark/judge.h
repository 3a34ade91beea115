// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../payload/message_text.h"
#include "layer_reading.h"

#include <optional>

namespace vcg_ext {

/// What the readings come to, the mask lifted. Probabilities as log10 of true bounds.
struct Judgement {
    /// One view of the carriers: a way of one layer, or of two together, the one behind the other. Its soft values are
    /// unmasked.
    struct View {
        double weight = 1;
        int layer = 0; ///< of the first
        int way = 0;
        bool blind = true; ///< chosen without the mask, so fit for decoding
        std::vector<double> soft;
    };

    /// A message as one view reads it.
    struct Read {
        double log10_p = 0; ///< that any message would be read so well
        Bits bits;
        Kind kind = Kind::Text;
    };

    /// Of the expected message, or of a list.
    struct Match {
        std::size_t candidate = 0;
        double log10_p = 0;   ///< of a list times twice its length; beside another random message a bound, too
        double runner_up = 0; ///< of the next, likewise
    };

    std::vector<View> views;    ///< weights sum to 1 at most over all views, and over the blind ones
    Read best;                  ///< of all blind views
    std::vector<Read> of_layer; ///< each by itself
    std::optional<Match> match; ///< with expected messages only
    std::vector<double> match_of_layer;
    std::size_t view = 0; ///< that speaks loudest: where the expected message, or the one read, is
};

/// The views that the layers' ways give: each layer's alone, and each layer behind the first, which share the weight
/// evenly. In views of two, soft values are log-likelihood ratios; a layer's that are standard errors z become 2 m z
/// with m^2 = mean z^2 - 1, at least 0, which looks at magnitudes alone.
[[nodiscard]] std::vector<Judgement::View> views_of(const std::vector<LayerReading>& layers);

/// The soft value of each coded bit: the sum over the layers that a view holds.
[[nodiscard]] std::vector<double> summed(const std::vector<double>& soft, int carriers);

/// Weighs expected messages, and decodes what is there without them. Of a list, messages of more bits than carriers are
/// passed over, but count among the candidates.
/// \param carriers of each layer
/// \param expected one of them at least fits, or there is none
[[nodiscard]] Judgement judge(const std::vector<LayerReading>& layers, int carriers,
                              const std::vector<Message>& expected);

} // namespace vcg_ext
