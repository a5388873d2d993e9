{{^operands}}
complete -c {{&program}} -f
{{/operands}}
{{#option}}
complete -c {{&program}} -l {{&name}}{{#letter}} -s {{&letter}}{{/letter}}{{^flag}}{{#file}} -rF{{/file}}{{^file}} -x{{/file}}{{/flag}}{{#choices}} -a '{{&choices}}'{{/choices}} -d '{{&fish}}'
{{/option}}
