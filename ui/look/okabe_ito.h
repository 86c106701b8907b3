#pragma once

#include <QColor>

/// Eight colours that people with any kind of colour vision tell apart (Okabe and Ito 2008), for series and
/// outcomes. Never the only difference: a dash, a marker, a glyph or a word goes with it.
namespace trapwright::look {

inline const QColor kBlack{0x00, 0x00, 0x00};
inline const QColor kOrange{0xE6, 0x9F, 0x00};
inline const QColor kSkyBlue{0x56, 0xB4, 0xE9};
inline const QColor kBluishGreen{0x00, 0x9E, 0x73};
inline const QColor kYellow{0xF0, 0xE4, 0x42};
inline const QColor kBlue{0x00, 0x72, 0xB2};
inline const QColor kVermillion{0xD5, 0x5E, 0x00};
inline const QColor kReddishPurple{0xCC, 0x79, 0xA7};

}  // namespace trapwright::look
