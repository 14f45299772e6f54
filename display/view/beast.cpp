// Beast's functions are compiled here, once: see BOOST_BEAST_SEPARATE_COMPILATION.
#include <boost/beast/src.hpp>
