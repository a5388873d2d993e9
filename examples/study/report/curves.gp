{{! Named series of points. }}
{{#foot}}
set label {{&foot}} at screen 0.99,0.018 right textcolor rgb '#666666'
{{/foot}}
set label {{&title}} at screen 0.5,0.965 center font ',{{title_size}}'
set encoding utf8
set border 3 lc rgb '#444444'
set grid lc rgb '#dddddd' lw 0.6 lt 1
set tmargin at screen {{top}}
set bmargin at screen 0.175
set key at screen 0.5,0.937 center top horizontal reverse Left samplen 2.5 width 1
{{&x_axis}}
set xlabel {{&x}}
{{#doubling}}
set xtics nomirror out ({{#tic}}{{comma}}'{{at}}' {{at}}{{/tic}})
{{/doubling}}
{{&y_axis}}
set ylabel {{&y}}
{{#series}}

{{! Without points it is still in the key. }}
$series{{number}} << EOD
{{#point}}
{{x}} {{y}}
{{/point}}
{{^point}}
NaN NaN
{{/point}}
EOD
{{/series}}
plot {{#series}}{{comma}}$series{{number}} using 1:2 with linespoints lw 1.8 pt {{mark}} ps 0.7 lc rgb '{{color}}' title {{&name}}{{/series}}
