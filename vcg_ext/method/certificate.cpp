// SPDX-License-Identifier: GPL-3.0-or-later
#include "certificate.h"

#include "../base/error.h"
#include "../base/text.h"
#include "marking.h"

namespace vcg_ext {

namespace {

constexpr std::string_view format = "mesh watermark certificate ";
constexpr std::string_view version = "1\n";
constexpr const char* cure = " Give the file that Embed wrote as Certificate when the mesh was marked.";

/// FNV-1a: for what gets damaged on the way, not against whoever wants it damaged.
std::uint64_t checksum(std::string_view bytes)
{
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char byte : bytes)
        hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
    return hash;
}

Certificate parsed(std::string_view bytes)
{
    ByteReader reader(bytes);
    Certificate certificate;
    certificate.carriers = reader.get<std::uint16_t>();
    certificate.key_check = reader.get<std::uint32_t>();
    certificate.impression = read_impression(reader);
    if (reader.get<std::uint8_t>() != 0) {
        Certificate::Waves& waves = certificate.waves.emplace();
        for (double& x : waves.axes.reshaped())
            x = reader.get<double>();
        for (int k = 0; k < certificate.carriers; ++k)
            waves.values.push_back(reader.get<float>());
    }
    if (reader.get<std::uint8_t>() != 0) {
        ShellFrame& shells = certificate.shells.emplace();
        for (double& x : shells.centre)
            x = reader.get<double>();
        shells.minimum = reader.get<double>();
        shells.maximum = reader.get<double>();
    }
    const bool sound = certificate.carriers >= 1 && certificate.carriers <= most_carriers && reader.left() == 0 &&
                       (!certificate.waves || certificate.impression.likeness.solid.length > 0) &&
                       (!certificate.shells || certificate.shells->minimum < certificate.shells->maximum);
    if (!sound)
        throw Error("The numbers make no sense.");
    return certificate;
}

} // namespace

std::uint32_t key_check_of(const Key& key)
{
    return static_cast<std::uint32_t>(key.stream("certificate").next());
}

std::string bytes_of(const Certificate& certificate)
{
    ByteWriter writer;
    writer.put(static_cast<std::uint16_t>(certificate.carriers));
    writer.put(certificate.key_check);
    write(writer, certificate.impression);
    writer.put(static_cast<std::uint8_t>(certificate.waves.has_value()));
    if (const auto& waves = certificate.waves) {
        for (const double x : waves->axes.reshaped())
            writer.put(x);
        for (const double value : waves->values)
            writer.put(static_cast<float>(value));
    }
    writer.put(static_cast<std::uint8_t>(certificate.shells.has_value()));
    if (const auto& shells = certificate.shells) {
        for (const double x : shells->centre)
            writer.put(x);
        writer.put(shells->minimum);
        writer.put(shells->maximum);
    }
    ByteWriter end;
    end.put(checksum(writer.bytes()));
    return std::string(format).append(version) + writer.bytes() + end.bytes();
}

Certificate certificate_of(std::string_view bytes)
{
    if (!starts_with(bytes, format))
        throw Error(std::string("The file is no certificate.") + cure);
    bytes.remove_prefix(format.size());
    if (!starts_with(bytes, version))
        throw Error("The certificate is of version " + std::string(bytes.substr(0, bytes.find('\n')).substr(0, 8)) +
                    ", but this program reads version 1. Read it with the version of the plugin that wrote it, or a "
                    "newer one.");
    bytes.remove_prefix(version.size());
    constexpr std::size_t end = sizeof(std::uint64_t);
    const std::string_view content = bytes.substr(0, bytes.size() > end ? bytes.size() - end : 0);
    ByteReader last(bytes.substr(content.size()));
    if (bytes.size() < end || last.get<std::uint64_t>() != checksum(content))
        throw Error(std::string("The certificate is cut off or damaged.") + cure);
    try {
        return parsed(content);
    } catch (const Error& error) {
        throw Error(std::string("The certificate is damaged: ") + error.what() + cure);
    }
}

} // namespace vcg_ext
