{{! Bars from 0: one or two values per category, each with a whisker. }}
{{#foot}}
set label {{&foot}} at screen 0.99,0.018 right textcolor rgb '#666666'
{{/foot}}
set label {{&title}} at screen 0.5,0.965 center font ',{{title_size}}'
set encoding utf8
set border 3 lc rgb '#444444'
set tmargin at screen 0.92
set grid y lc rgb '#dddddd' lw 0.6 lt 1
set ylabel {{&y}}
set key inside top left Left reverse samplen 1.5 opaque
set style fill solid 0.9 noborder
set xrange [-0.6:{{right}}]
{{&y_axis}}

{{! Names below each other where there are few bars, with notes, else turned. }}
set xtics nomirror out scale 0 {{turn}} ({{#bar}}{{comma}}{{&name}} {{number}}{{/bar}})
set bmargin at screen 0.2
set rmargin at screen 0.93
{{#bar}}
{{#note}}
set label {{&note}} at first {{number}}, screen 0.11 center textcolor rgb '#555555'
{{/note}}
{{/bar}}

{{! Each value, and the ends of its whisker. }}
$bars << EOD
{{#bar}}
{{#value}}{{middle}} {{low}} {{high}} {{/value}}
{{/bar}}
EOD
set boxwidth {{width}}
plot {{#box}}{{comma}}$bars using ($0 + {{offset}}):{{middle}} with boxes lc rgb '{{color}}' title {{&name}}, \
  '' using ($0 + {{offset}}):{{low}}:(0):(${{high}} - ${{low}}) with vectors heads size graph 0.006,90 lw 2 lc rgb '#222222' notitle{{/box}}
