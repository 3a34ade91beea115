// SPDX-License-Identifier: GPL-3.0-or-later
#include "certified.h"

#include "../geometry/body.h"
#include "../method/methods.h"
#include "../payload/code.h"
#include "copies.h"

namespace vcg_ext {

Certificate make_certificate(const Surface& original, const Key& key, const EmbedOptions& options)
{
    options.carriers.check();
    CarrierOptions carriers = options.carriers;
    if (carriers.bits == 0)
        carriers.bits = recommended_carriers(options.message);
    const Body body = body_of(original);
    Certificate certificate;
    certificate.carriers = carriers.bits;
    certificate.key_check = key_check_of(key);
    certificate.impression = impression_of(body.surface);
    bool any = false;
    for (const auto& [layer, strength] : row_of(carriers.method).layers) {
        const MethodRow& method = row_of(layer);
        if (!method.certify)
            continue;
        carriers.method = layer;
        method.certify(body.surface, method.plan(key, carriers), certificate);
        any = true;
    }
    if (!any)
        throw Error(std::string("There are no certificates for ") + name(options.carriers.method) +
                    ", which needs the original itself. Leave Certificate empty and keep the original, or take another "
                    "method.");
    return certificate;
}

DetectReport detect_with_certificate(const Surface& surface, const Certificate& certificate, const Key& key,
                                     const DetectOptions& wanted, const Progress& progress)
{
    wanted.carriers.check();
    DetectOptions options = wanted;
    if (certificate.key_check != key_check_of(key))
        throw Error("The certificate was made with another key. Give the key of embedding, or the certificate that was "
                    "made with this one.");
    if (options.carriers.bits == 0)
        options.carriers.bits = certificate.carriers;
    if (options.carriers.bits != certificate.carriers)
        throw Error("The certificate was made for " + std::to_string(certificate.carriers) + " bits, but Bits is " +
                    std::to_string(options.carriers.bits) + ". Set Bits to 0, or give the certificate of this mark.");
    const FootSearch scales(scales_of(certificate.impression));
    const Registrar registrar(scales, certificate.impression);
    const CopyReader reader = [&](const Surface& copy, const Registration& registration) -> LayerReader {
        return [&](const MethodRow& method, const Plan& plan) {
            return read_certified(method, {certificate, copy, registration}, plan);
        };
    };
    return detect_copies(surface, registrar, reader, key, options, progress);
}

} // namespace vcg_ext
