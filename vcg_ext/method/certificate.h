// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "../carrier/shells.h"
#include "../geometry/registration.h"
#include "../key/key.h"

#include <optional>
#include <string>
#include <string_view>

namespace vcg_ext {

/// What is kept of an original for who may not keep, or send, the original itself: some 25 kB.
///
/// Neither the key nor the mask of its bits is in it. The waves' values are those of waves that only the key tells: a
/// number each, where a wave has four. Who has them can see whether a guess of the key is right, as who has a marked
/// mesh can, so the check of the key tells no more. But the shape of the original is in it, and with it where the mark
/// moved the surface: keep it where the original would be kept.
struct Certificate {
    int carriers = 0;
    std::uint32_t key_check = 0;
    Impression impression;

    /// What Waves needs.
    struct Waves {
        Eigen::Matrix3d axes; ///< in which waves are counted; centre and radius are those of the impression's solid
        std::vector<double> values; ///< m_k of the original
    };
    std::optional<Waves> waves;
    std::optional<ShellFrame> shells; ///< what the methods of vertex norms need
};

/// A part of a certificate. \throw Error where it has not that part
template <class Part>
[[nodiscard]] const Part& certified(const std::optional<Part>& part)
{
    if (!part)
        throw Error("The certificate was made for another method. Set the Method of embedding, or give the original "
                    "itself.");
    return *part;
}

/// A one-way draw of 32 bits: whether a certificate was made with this key.
[[nodiscard]] std::uint32_t key_check_of(const Key& key);

/// As the file has it. Starts with a line of text that names the format and its version.
[[nodiscard]] std::string bytes_of(const Certificate& certificate);

/// \throw Error where the bytes are no certificate, one of another version, cut off or damaged
[[nodiscard]] Certificate certificate_of(std::string_view bytes);

/// A surface that was registered to the original of which a certificate is left.
struct CertifiedCopy {
    const Certificate& certificate;
    const Surface& surface;
    Registration registration;
};

} // namespace vcg_ext
