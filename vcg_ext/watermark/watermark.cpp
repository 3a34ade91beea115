#include "watermark.h"

#include "../base/check.h"
#include "../base/parallel.h"
#include "../base/progress.h"
#include "../base/weld.h"
#include "../carrier/shells.h"
#include "../carrier/statistic.h"
#include "../key/stream.h"
#include "../method/geodesic.h"
#include "../method/norms.h"
#include "../method/spectral.h"
#include "../metric/displacement.h"
#include "../payload/binomial.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace vcg_ext {

namespace {

constexpr double most_trim = 0.45;

/// Seconds since it was last asked.
class Stopwatch {
public:
    double lap()
    {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        last_ = now;
        return seconds;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// What the key decides about the carriers of one call.
struct Secrets {
    double trim = 0;
    std::vector<int> carrier_of_bit;
    Bits mask; ///< XOR-ed into the message: so a wrong key's bits match by even chance, and p is exact
};

Secrets draw_secrets(const Key& key, const CarrierOptions& options)
{
    Secrets secrets;
    if (options.method == Method::Spectral) {
        PatchPlan plan = patch_plan(key, options.bits, options.trim, options.as_printed);
        secrets.trim = plan.trim;
        secrets.carrier_of_bit = std::move(plan.order);
    } else {
        secrets.trim = options.trim;
        if (options.trim < 0) {
            // Norms: in [0, 0.15] (thesis 5.2.1). Strips: the thesis draws from (0, 0.2), but where nearly nothing is
            // cut off, the first and the last strip are too small to hold a vertex; so in [0.05, 0.2].
            const double least = options.method == Method::Geodesic ? 0.05 : 0;
            secrets.trim = least + static_cast<double>(key.stream("epsilon").below(15001)) / 1e5;
        }
        secrets.carrier_of_bit = key.stream("carrier-order").permutation(options.bits);
    }
    Stream mask = key.stream("bit-mask");
    for (int i = 0; i < options.bits; ++i)
        secrets.mask.push_back(static_cast<std::uint8_t>(mask.below(2)));
    return secrets;
}

std::string text(double number)
{
    std::string digits = std::to_string(number);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.')
        digits.pop_back();
    return digits;
}

void check_options(const CarrierOptions& options)
{
    if (options.bits < 1 || options.bits > most_bits)
        throw Error("Bits is " + std::to_string(options.bits) + ", but must lie between 1 and " +
                    std::to_string(most_bits) + ".");
    if (!(options.trim == -1 || (options.trim >= 0 && options.trim <= most_trim)))
        throw Error("Trim is " + text(options.trim) + ", but must lie between 0 and " + text(most_trim) +
                    ", or be -1 to be drawn from the key.");
}

/// The strength as it will be used; within what the method bears.
double checked_strength(const EmbedOptions& options)
{
    struct Range {
        double usual, above, most;
    };
    const Range range = options.method == Method::Spectral     ? Range{15, 2, 1000}
                        : options.statistic == Statistic::Mean ? Range{0.1, 0, 0.45}
                                                               : Range{0.1, 0, 0.3};
    const double strength = options.strength == 0 ? range.usual : options.strength;
    if (!(strength > range.above && strength <= range.most))
        throw Error("Strength is " + text(strength) + ", but for this method it must lie above " + text(range.above) +
                    " and up to " + text(range.most) + ", or be 0 for the default of " + text(range.usual) + ".");
    return strength;
}

Points rounded_to_float(const Points& points)
{
    Points result(points.size());
    for_each_index(static_cast<int>(points.size()), [&](int v) { result[v] = points[v].cast<float>().cast<double>(); });
    return result;
}

/// Part of a carrier that rounding to float can move a value by, with room to spare.
double float_guard(const Points& points, const Carriers& carriers)
{
    const double largest =
        ordered_maximum(static_cast<int>(points.size()), 0.0, [&](int v) { return points[v].cwiseAbs().maxCoeff(); });
    return 4 * std::numeric_limits<float>::epsilon() * largest / carriers.width;
}

ScalarMethod scalar_method(const Cover& cover, const Key& key, const EmbedOptions& options, double trim,
                           EmbedReport& report)
{
    if (options.method == Method::Geodesic)
        return geodesic_method(cover, key, options, trim, report);
    return norm_method(cover, options, trim, report);
}

/// The carriers as a blind detector finds them.
Carriers found_carriers(const Surface& surface, const Key& key, const CarrierOptions& options, DetectReport& report)
{
    if (options.method == Method::Geodesic) {
        const VertexFaces around = vertex_faces(static_cast<int>(surface.points.size()), surface.triangles);
        const Strips strips = read_strips(surface, around, key, report.trim, options.bits, options.statistic);
        report.smoothing_rounds = strips.smoothing_rounds;
        report.warnings = strip_warnings(strips);
        return strips.carriers;
    }
    return shells(surface.points, surface.triangles, report.trim, options.bits).carriers;
}

/// Carriers, as many as can be found by doubling `count` and then halving the interval, of which none is empty.
int most_carriers(const ScalarMethod& method, int count)
{
    const auto none_empty = [&](int carriers) {
        const std::vector<int> held = samples(method.cut(carriers));
        return std::find(held.begin(), held.end(), 0) == held.end();
    };
    int filled = count;
    while (filled < most_bits && none_empty(std::min(2 * filled, most_bits)))
        filled = std::min(2 * filled, most_bits);
    for (int empty = std::min(2 * filled, most_bits); filled < most_bits && empty - filled > 1;) {
        const int middle = (filled + empty) / 2;
        (none_empty(middle) ? filled : empty) = middle;
    }
    return filled;
}

/// The bits to be written, by carrier.
std::vector<char> carrier_bits(const Bits& message, const Secrets& secrets)
{
    std::vector<char> bits(message.size());
    for (std::size_t i = 0; i < message.size(); ++i)
        bits[secrets.carrier_of_bit[i]] = static_cast<char>(message[i] ^ secrets.mask[i]);
    return bits;
}

std::string list_wrong_bits(const std::vector<double>& margins, const Secrets& secrets)
{
    std::string list;
    for (std::size_t i = 0; i < margins.size(); ++i)
        if (margins[secrets.carrier_of_bit[i]] <= 0)
            list += (list.empty() ? "" : ", ") + std::to_string(i);
    return list;
}

void read_bits(const Carriers& carriers, const Secrets& secrets, DetectReport& report)
{
    const std::vector<int> count = samples(carriers);
    const std::vector<double> read = statistics(carriers, report.statistic);
    const double middle = threshold(report.statistic);
    const int bits = static_cast<int>(secrets.mask.size());
    std::vector<int> bit_of_carrier(bits);
    for (int i = 0; i < bits; ++i) {
        const int k = secrets.carrier_of_bit[i];
        const double soft = count[k] > 0 ? (read[k] - middle) / standard_error(report.statistic, count[k]) : 0;
        report.bits.push_back(static_cast<std::uint8_t>((soft > 0) ^ secrets.mask[i]));
        report.soft.push_back(secrets.mask[i] ? -soft : soft);
        report.samples.push_back(count[k]);
        bit_of_carrier[k] = i;
    }
    report.carrier_of_vertex = carriers.label;
    for (int& label : report.carrier_of_vertex)
        if (label >= 0)
            label = bit_of_carrier[label];
}

/// \param tries how many readings the report is the best of
void judge(const Bits& expected, int tries, DetectReport& report)
{
    const int bits = static_cast<int>(report.bits.size());
    const int matches = matching_bits(pad_message(expected, bits), report.bits);
    report.detection_ratio = static_cast<double>(matches) / bits;
    report.p_value = std::min(1.0, tries * binomial_tail(bits, matches));
    report.present = *report.p_value < 1e-6;
}

/// Embeds by the methods that have one scalar per vertex.
Points place_scalar(const Cover& cover, const Key& key, const Secrets& secrets, const EmbedOptions& options,
                    EmbedReport& result, const Progress& progress)
{
    const ScalarMethod method = scalar_method(cover, key, options, secrets.trim, result);
    const std::vector<int> count = samples(method.cover);
    result.samples_min = *std::min_element(count.begin(), count.end());
    if (result.samples_min == 0)
        throw Error(std::to_string(std::count(count.begin(), count.end(), 0)) + " of the " +
                    std::to_string(options.bits) + " carriers hold no vertex.");
    result.capacity = most_carriers(method, options.bits);
    const double guard = float_guard(cover.points, method.cover);
    bool as_float = true;
    if (guard > 0.2) {
        if (options.storage == Storage::Float)
            throw Error(
                "The mesh lies so far from the origin, or has so little range, that float coordinates are coarser than "
                "its carriers. Move it to the origin, or use another method.");
        as_float = false;
        result.warnings.emplace_back(
            "The mark is finer than float coordinates: save to a file format that holds doubles, or "
            "move the mesh to the origin first.");
    }
    const auto round = [as_float](const Points& points) { return as_float ? rounded_to_float(points) : points; };
    ScalarResult placed =
        embed_scalar(method, options.statistic, carrier_bits(result.bits, secrets), result.strength,
                     std::max({as_float ? guard : 0, method.guard, 1e-6}), options.max_rounds, round, progress);
    result.rounds = placed.rounds;
    const std::string wrong = list_wrong_bits(placed.margins, secrets);
    if (!wrong.empty())
        throw Error("These bits could not be read back: " + wrong + ".");
    return std::move(placed.points);
}

/// Reads blind what was embedded: without the message, unless the body's ends can only be told apart by it.
double self_check(const Surface& marked, const Key& key, const CarrierOptions& options, EmbedReport& result)
{
    DetectOptions blind;
    static_cast<CarrierOptions&>(blind) = options;
    if (detect(marked, key, blind).bits == result.bits)
        return 1;
    blind.expected = result.bits;
    const double ratio = *detect(marked, key, blind).detection_ratio;
    if (ratio == 1)
        result.warnings.emplace_back("The body is so symmetric that with this key the message can only be read by who "
                                     "knows what to expect. Set it for detection too, or take another key.");
    return ratio;
}

struct Marked {
    EmbedReport report;
    Points points;
};

/// \param options checked and complete
Marked mark(const Surface& surface, const Welded& welded, const Key& key, const EmbedOptions& options,
            const Progress& progress)
{
    Stopwatch watch;
    EmbedReport result;
    result.method = options.method;
    result.statistic = options.statistic;
    result.bits = options.message;
    result.strength = options.strength;
    result.carriers = options.bits;
    const Secrets secrets = draw_secrets(key, options);
    result.trim = secrets.trim;
    const Cover cover(welded.surface);
    const Points placed = options.method == Method::Spectral
                              ? embed_spectral(cover, {secrets.carrier_of_bit, secrets.trim, options.as_printed},
                                               secrets.mask, options, rounded_to_float, result, progress)
                              : place_scalar(cover, key, secrets, options, result, progress);
    result.seconds["placement"] = watch.lap();

    report(progress, 85, "Checking blind");
    Surface marked{unweld(surface.points, welded.site_of_vertex, placed), surface.triangles};
    if (options.storage == Storage::Float)
        marked.points = rounded_to_float(marked.points);
    result.detection_ratio = self_check(marked, key, options, result);
    if (result.detection_ratio < 1)
        throw Error("The blind self-check did not read every bit back.");
    result.seconds["check"] = watch.lap();

    report(progress, 95, "Measuring");
    result.moved_vertices = moved_count(surface.points, marked.points);
    result.max_displacement = max_displacement(surface.points, marked.points);
    result.mrms = local_mrms(cover.points, placed, cover.triangles, cover.around);
    result.mrms_relative = result.mrms / bounding_diagonal(welded.surface);
    result.seconds["measure"] = watch.lap();
    return {std::move(result), std::move(marked.points)};
}

/// Fewer bits that do read back, by trying three quarters of the last number again and again; 0 where not even one
/// does. Both the message's first bits and their opposites must: so every carrier has carried either.
int bits_that_read_back(const Surface& surface, const Welded& welded, const Key& key, const EmbedOptions& wanted,
                        const Progress& progress)
{
    const auto reads_back = [&](const Bits& message) {
        EmbedOptions options = wanted;
        options.bits = static_cast<int>(message.size());
        options.message = message;
        try {
            mark(surface, welded, key, options,
                 [&progress](int, const char*) { return !progress || progress(50, "Finding how many bits fit"); });
            return true;
        } catch (const Cancelled&) {
            throw;
        } catch (const Error&) {
            return false;
        }
    };
    for (int bits = 3 * wanted.bits / 4; bits > 0; bits = 3 * bits / 4) {
        Bits message(wanted.message.begin(), wanted.message.begin() + bits);
        if (!reads_back(message))
            continue;
        for (std::uint8_t& bit : message)
            bit ^= 1;
        if (reads_back(message))
            return bits;
    }
    return 0;
}

} // namespace

const char* name(Method method)
{
    constexpr const char* names[] = {"L-M", "QSP", "Cho", "Geodesic", "Spectral"};
    return names[static_cast<int>(method)];
}

TooManyBits::TooManyBits(const std::string& cause, int number)
    : Error(
          cause +
          (number > 0
               ? " This mesh carries " + std::to_string(number) +
                     " bits with this method and key: set Bits to that, shorten the message, or use a "
                     "finer mesh."
               : " With this method and key this mesh carries not even one bit: use another method, or a finer mesh.")),
      carries(number)
{
}

EmbedReport embed(Surface& surface, const Key& key, const EmbedOptions& wanted, const Progress& progress)
{
    EmbedOptions options = wanted;
    if (options.bits == 0)
        options.bits = static_cast<int>(options.message.size());
    check_options(options);
    options.message = pad_message(options.message, options.bits);
    options.strength = checked_strength(options);
    report(progress, 0, "Finding carriers");
    const Welded welded = checked_weld(surface);
    try {
        Marked marked = mark(surface, welded, key, options, progress);
        report(progress, 100, "Done");
        surface.points = std::move(marked.points);
        return marked.report;
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& cause) {
        throw TooManyBits(cause.what(), bits_that_read_back(surface, welded, key, options, progress));
    }
}

DetectReport detect(const Surface& surface, const Key& key, const DetectOptions& options, const Progress& progress)
{
    Stopwatch watch;
    check_options(options);
    DetectReport result;
    result.method = options.method;
    result.statistic = options.statistic;
    report(progress, 0, "Finding carriers");
    const Welded welded = checked_weld(surface);
    const Secrets secrets = draw_secrets(key, options);
    result.trim = secrets.trim;
    report(progress, 30, "Reading");
    int tries = 1;
    if (options.method == Method::Spectral)
        tries = detect_spectral(welded.surface, {secrets.carrier_of_bit, secrets.trim, options.as_printed},
                                secrets.mask, options, result);
    else
        read_bits(found_carriers(welded.surface, key, options, result), secrets, result);
    std::vector<int> carrier_of_vertex(surface.points.size(), -1);
    for (std::size_t v = 0; v < carrier_of_vertex.size(); ++v)
        if (welded.site_of_vertex[v] >= 0)
            carrier_of_vertex[v] = result.carrier_of_vertex[welded.site_of_vertex[v]];
    result.carrier_of_vertex = std::move(carrier_of_vertex);
    if (options.expected)
        judge(*options.expected, tries, result);
    result.seconds["detection"] = watch.lap();
    report(progress, 100, "Done");
    return result;
}

} // namespace vcg_ext
