#include "text.h"

#include <iomanip>
#include <locale>
#include <sstream>

namespace vcg_ext {

std::string text(double number)
{
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    stream << std::setprecision(6) << number;
    return stream.str();
}

} // namespace vcg_ext
