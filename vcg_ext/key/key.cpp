// SPDX-License-Identifier: GPL-3.0-or-later
#include "key.h"

#include "../base/error.h"

#include <cstdlib>
#include <fstream>
#include <mutex>
#include <sodium.h>
#include <string>
#include <system_error>
#include <vector>

namespace vcg_ext {

namespace {

// The salt is part of the format: with another one, no mark made so far could be read.
constexpr char salt[] = "filter_watermark";
static_assert(sizeof salt - 1 == crypto_pwhash_SALTBYTES);
constexpr unsigned long long passes = 2;
constexpr std::size_t memory = 64u << 20;

/// Wipes memory before it goes back.
template <class Value>
struct WipingAllocator : std::allocator<Value> {
    template <class Other>
    struct rebind {
        using other = WipingAllocator<Other>;
    };

    void deallocate(Value* values, std::size_t count)
    {
        sodium_memzero(values, count * sizeof(Value));
        std::allocator<Value>::deallocate(values, count);
    }
};

/// Bytes that leave nothing behind when they grow, move or end.
using Secret = std::vector<char, WipingAllocator<char>>;

void derive(const Secret& secret, std::array<unsigned char, 32>& master)
{
    static std::mutex one_at_a_time; // each takes its memory
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    if (crypto_pwhash(master.data(), master.size(), secret.data(), secret.size(),
                      reinterpret_cast<const unsigned char*>(salt), passes, memory, crypto_pwhash_ALG_ARGON2ID13) != 0)
        throw Error("Not enough memory: deriving the key needs 64 MiB. Close other programs and try again.");
}

Secret read_file(const std::string& path)
{
    std::ifstream file;
    file.rdbuf()->pubsetbuf(nullptr, 0); // its buffer would keep the bytes
    file.open(path, std::ios::binary);
    const auto fail = [&path] {
        throw Error("The key file '" + path + "' cannot be read. Check its path and permissions.");
    };
    if (!file)
        fail();
    Secret bytes;
    for (constexpr std::size_t piece = 4096; file;) {
        const std::size_t size = bytes.size();
        bytes.resize(size + piece);
        file.read(bytes.data() + size, piece);
        bytes.resize(size + file.gcount());
    }
    if (file.bad()) // a folder can be opened
        fail();
    for (const char end : {'\n', '\r'}) // editors end the last line, and differ in how
        if (!bytes.empty() && bytes.back() == end)
            bytes.pop_back();
    if (bytes.empty())
        throw Error("The key file '" + path + "' is empty. Write the secret into it, or name another.");
    return bytes;
}

Secret to_secret(std::string_view text)
{
    return Secret(text.begin(), text.end());
}

Secret read_environment(const std::string& name)
{
    const char* value = std::getenv(name.c_str());
    if (!value || !*value)
        throw Error("The environment variable '" + name +
                    "', which should hold the key, is not set. Set it and try again.");
    return to_secret(value);
}

} // namespace

Key::Master::~Master()
{
    sodium_memzero(bytes.data(), bytes.size());
}

Key::Key(std::string_view secret)
{
    if (secret.empty())
        throw Error("The key is empty. Give a passphrase, file:PATH or env:NAME.");
    if (sodium_init() < 0)
        throw Error("libsodium could not start, so there is no key. Check the system's source of random numbers.");
    const auto derived = [secret = to_secret(secret)] {
        auto master = std::make_unique<Master>();
        derive(secret, master->bytes);
        return std::unique_ptr<const Master>(std::move(master));
    };
    try {
        master_ = std::async(std::launch::async, derived).share();
    } catch (const std::system_error&) { // no thread is to be had: whoever asks first derives it
        master_ = std::async(std::launch::deferred, derived).share();
    }
}

Stream Key::stream(std::string_view purpose) const
{
    const std::array<unsigned char, 32>& master = master_.get()->bytes;
    Master subkey; // wiped when it ends, as the stream's own copy is
    crypto_generichash(subkey.bytes.data(), subkey.bytes.size(), reinterpret_cast<const unsigned char*>(purpose.data()),
                       purpose.size(), master.data(), master.size());
    return Stream(subkey.bytes);
}

Key key_from_text(std::string_view text)
{
    const auto rest = [text](std::size_t begin) { return std::string(text.substr(begin)); };
    const Secret secret = text.substr(0, 5) == "file:"  ? read_file(rest(5))
                          : text.substr(0, 4) == "env:" ? read_environment(rest(4))
                                                        : to_secret(text);
    return Key({secret.data(), secret.size()});
}

} // namespace vcg_ext
